// The stress tests of the laws, and that their assessments notice a broken law.
#include "../../src/verify/law_tests.hpp"

#include "launchsafe/run/processor_time.hpp"
#include "launchsafe/verify/stress_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

namespace launchsafe::verify::law_tests {
namespace {

using materials::maxwell_elements;
using math::Deviator;

template <class Law, class... Arguments>
Outcome outcome_of(void (*assess_law)(Bounds&, const Law&, Arguments...), const Law& law,
                   std::type_identity_t<Arguments>... arguments) {
  Bounds bounds;
  assess_law(bounds, law, arguments...);
  return bounds.finding().outcome;
}

TEST(LawStressTests, NoneIsWrong) {
  const double begin = run::thread_processor_time();
  for (const StressTest& test : law_stress_tests()) {
    const Finding finding = test.compute();
    EXPECT_NE(finding.outcome, Outcome::wrong) << test.group << ": " << test.name << ": " << finding.text;
    EXPECT_FALSE(finding.text.empty()) << test.group << ": " << test.name;
  }
  const double time = run::thread_processor_time() - begin;
  RecordProperty("processor_s", std::to_string(time));
#ifdef NDEBUG
  EXPECT_LT(time, 30.0);
#endif
}

TEST(LawStressTests, AreNamedApartAndSayWhatMustHold) {
  std::set<std::string> names;
  for (const StressTest& test : law_stress_tests()) {
    EXPECT_FALSE(test.group.empty() || test.name.empty() || test.must_hold.empty());
    EXPECT_TRUE(names.insert(test.group + "/" + test.name).second)
        << "twice: " << test.group << ": " << test.name;
  }
}

TEST(LawStressTests, FindTheSameOnAnyThread) {
  for (const StressTest& test : law_stress_tests()) {
    if (test.group != "stiff: crack growth" && test.group != "stiff: conduction") continue;
    Finding elsewhere;
    std::thread([&] { elsewhere = test.compute(); }).join();
    const Finding here = test.compute();
    EXPECT_EQ(elsewhere.outcome, here.outcome) << test.name;
    EXPECT_EQ(elsewhere.text, here.text) << test.name;
  }
}

TEST(Outcome, HasAWord) {
  EXPECT_EQ(to_string(Outcome::held), "held");
  EXPECT_EQ(to_string(Outcome::degraded), "degraded");
  EXPECT_EQ(to_string(Outcome::caught), "caught");
  EXPECT_EQ(to_string(Outcome::wrong), "WRONG");
}

TEST(Bounds, ComparesWithTheBound) {
  Bounds bounds;
  bounds.at_most("a", 1.0, 1.0);
  EXPECT_EQ(bounds.finding().outcome, Outcome::held);
  bounds.at_most("a", 1.1, 1.0);
  bounds.at_most("a", 0.5, 1.0);  // a later good one does not hide it
  EXPECT_EQ(bounds.finding().outcome, Outcome::wrong);
}

TEST(Bounds, TakesNotANumberForBroken) {
  for (const bool value : {true, false}) {
    Bounds bounds;
    const double nan = std::nan("");
    bounds.at_most("a", value ? nan : 1.0, value ? 1.0 : nan);
    bounds.at_most("a", 0.5, 1.0);
    EXPECT_EQ(bounds.finding().outcome, Outcome::wrong);
  }
}

TEST(Bounds, DoesNotExcuseAFaultByAFlag) {
  Bounds bounds;
  bounds.caught("flagged");
  EXPECT_EQ(bounds.finding().outcome, Outcome::caught);
  bounds.never("it happened", true);
  EXPECT_EQ(bounds.finding().outcome, Outcome::wrong);
}

TEST(Bounds, IsNotContentWithNothing) { EXPECT_EQ(Bounds{}.finding().outcome, Outcome::wrong); }

// ---- broken laws ----

surface::SkinModel reacting() {
  surface::SkinModel model;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 4000.0;
  return model;
}

/// One explicit Euler step of the skin equation.
surface::SkinPoint euler_skin(const surface::SkinModel& model, double gap, surface::SkinPoint point,
                              double dt, double air_begin, double, double heating) {
  const double rate = surface::heat_capacity_ratio(model, gap) / model.surface.exchange_time;
  point.temperature +=
      dt * (rate * (air_begin - point.temperature) + heating +
            materials::arrhenius_heating(model.kinetics, model.specific_heat, point.temperature));
  point.ignited = point.temperature >= model.kinetics.burnt_temperature;
  point.ignition_time = dt;
  return point;
}

TEST(BrokenLaw, ExplosionByExplicitSteps) {
  const double nothing = 0.0;
  EXPECT_EQ(outcome_of(assess_explosion, SkinLaw(surface::advance_skin), reacting(), 700.0, nothing, 1e-5),
            Outcome::held);
  EXPECT_EQ(outcome_of(assess_explosion, SkinLaw(euler_skin), reacting(), 700.0, nothing, 1e-5),
            Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_explosion, SkinLaw(euler_skin), reacting(), 2000.0, nothing, 1e-9),
            Outcome::wrong);
}

TEST(BrokenLaw, ExplosionThatIsNotFlagged) {
  const SkinLaw inert = [](const auto&, double, surface::SkinPoint point, double, double, double, double) {
    return point;
  };
  EXPECT_EQ(outcome_of(assess_explosion, inert, reacting(), 700.0, 0.0, 1e-3), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_explosion, inert, reacting(), 5000.0, 0.0, 1e-3), Outcome::wrong);
  const SkinLaw unknown = [](const auto&, double, surface::SkinPoint point, double, double, double, double) {
    point.temperature = std::nan("");
    return point;
  };
  EXPECT_EQ(outcome_of(assess_explosion, unknown, reacting(), 700.0, 0.0, 1e-3), Outcome::wrong);
}

TEST(BrokenLaw, ExchangeByExplicitSteps) {
  for (const double step : {1e-7, 1e-3})
    EXPECT_EQ(outcome_of(assess_exchange, SkinLaw(euler_skin), 1e-6, step), Outcome::wrong) << step;
  EXPECT_EQ(outcome_of(assess_printed_exchange, SkinLaw(euler_skin), 4e-4, 1e-6), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_printed_exchange, SkinLaw(euler_skin), 1.0, 1e-6), Outcome::wrong);
}

TEST(BrokenLaw, FilmOfAirThatKeepsItsHeat) {
  const HistoryLaw reservoir = [](surface::SkinModel model, const trace::BottomTrace& trace, double gap) {
    model.surface.air_model = scene::AirModel::reservoir;
    surface::SkinHistory history = surface::integrate_skin(model, trace, gap);
    // Heat that comes from nowhere, as a ledger would state it.
    history.energy_residual = 0.5;
    return history;
  };
  EXPECT_EQ(outcome_of(assess_film, reservoir, 1e-4, 1e-2, 1e8), Outcome::wrong);
  const HistoryLaw cooling = [](const surface::SkinModel& model, const trace::BottomTrace& trace,
                                double gap) {
    surface::SkinHistory history = surface::integrate_skin(model, trace, gap);
    history.temperature.back() -= 1.0;
    return history;
  };
  EXPECT_EQ(outcome_of(assess_film, cooling, 1e-6, 1e-2, 1e8), Outcome::wrong);
}

TEST(BrokenLaw, RelaxationByExplicitSteps) {
  const SolidLaw explicit_steps = [](const Solid& solid, double dt, SolidState& state,
                                     Deviator<double> strain, double) {
    for (std::size_t n = 0; n < maxwell_elements; ++n) {
      auto& s = state.elements[n];
      s = s + (2.0 * solid.shear_moduli[n]) * strain - (dt * solid.relaxation_rates[n]) * s;
    }
    return materials::ViscoScramDissipation<double>{};
  };
  EXPECT_EQ(outcome_of(assess_relaxation, explicit_steps, 1e-3, 1e-9), Outcome::wrong);  // loses no energy
  EXPECT_EQ(outcome_of(assess_relaxation, explicit_steps, 1e-12, 1e-9), Outcome::wrong);
}

TEST(BrokenLaw, CracksThatDoNotSlowTheRelaxation) {
  const SolidLaw whole = [](Solid solid, double dt, SolidState& state, Deviator<double> strain, double p) {
    solid.flaw_size = 0.0;
    return materials::visco_scram_update<double>(solid, materials::relaxation(solid, dt), state, strain, p);
  };
  EXPECT_EQ(outcome_of(assess_cracked_relaxation, whole, 1e-7, 1e-6, 0.5), Outcome::wrong);
}

TEST(BrokenLaw, GrowthByOneExplicitStep) {
  const SolidLaw explicit_step = [](Solid solid, double dt, SolidState& state, Deviator<double> strain,
                                    double p) {
    state.crack_radius += dt * materials::crack_growth_speed_under(solid, materials::total_deviator(state), p,
                                                                   state.crack_radius);
    solid.growth = false;
    return materials::visco_scram_update<double>(solid, materials::relaxation(solid, dt), state, strain, p);
  };
  for (const double factor : {10.0, 1000.0})
    EXPECT_EQ(outcome_of(assess_growth, explicit_step, factor * 24e6, 0.0, 1e-4), Outcome::wrong);
}

TEST(BrokenLaw, ReturnThatMissesTheYieldSurface) {
  const auto back = materials::johnson_cook_return<double>;
  const ReturnLaw elastic = [](const auto&, Deviator<double> trial, double, double, double) {
    return materials::JohnsonCookReturn<double>{trial, 0.0, 0.0};
  };
  const ReturnLaw near = [&](const auto& k, Deviator<double> trial, double strain, double t, double dt) {
    auto result = back(k, trial, strain, t, dt);
    result.stress = (1.0 + 1e-6) * result.stress;
    return result;
  };
  const ReturnLaw giving = [&](const auto& k, Deviator<double> trial, double strain, double t, double dt) {
    auto result = back(k, trial, strain, t, dt);
    result.plastic_work = -result.plastic_work;
    return result;
  };
  for (const ReturnLaw& law : {elastic, near, giving})
    EXPECT_EQ(outcome_of(assess_return, law, 1e9, 0.01, 300.0, 1e-7), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_return, elastic, 1e9, 0.0, std::nan(""), 1e-7), Outcome::wrong);
}

TEST(BrokenLaw, FlowStressWithoutItsBounds) {
  const FlowLaw bare = [](const auto& k, double strain, double rate, double temperature) {
    const double homologous =
        (temperature - k.room_temperature) / (k.melting_temperature - k.room_temperature);
    return (k.a + k.b * std::pow(strain, k.n)) * (1.0 + k.c * std::log(rate / k.reference_rate)) *
           (1.0 - std::pow(homologous, k.m));
  };
  EXPECT_EQ(outcome_of(assess_flow_stress, bare, 0.1, 1e-12, 300.0), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_flow_stress, bare, 0.1, 0.0, 300.0), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_flow_stress, bare, 0.1, 1e3, 200.0), Outcome::wrong);
}

TEST(BrokenLaw, JwlByTheMeanOfTwoPressures) {
  const materials::JwlParameters m = materials::unreacted_composition_b();
  const JwlLaw mean = [](const auto& k, double v0, double p0, double energy0, double v1) {
    const double half = 0.5 * (v1 - v0), cold = materials::jwl_cold_pressure(k, v1), stiffness = k.omega / v1;
    const double energy = (energy0 - half * (p0 + cold)) / (1.0 + half * stiffness);
    return materials::JwlState<double>{cold + stiffness * energy, energy};
  };
  for (const double v : {0.3, 0.5, 5.0})
    EXPECT_EQ(outcome_of(assess_jwl, mean, m, v, 1), Outcome::wrong) << v;
  EXPECT_EQ(outcome_of(assess_jwl, mean, m, 0.3, 10000), Outcome::held);  // it is second order
}

TEST(BrokenLaw, SteelByThePressureBefore) {
  const SteelPressureLaw before = [](const auto& m, double mu0, double p0, double energy0, double mu1) {
    const double dv = (mu0 - mu1) / (m.density * (1.0 + mu0) * (1.0 + mu1));
    const double energy = energy0 - p0 * dv;
    return materials::MieGruneisenState<double>{materials::mie_gruneisen_pressure(m, mu1, energy), energy};
  };
  EXPECT_EQ(outcome_of(assess_steel_pressure, before, 0.0, 0.5, 10), Outcome::wrong);
}

TEST(BrokenLaw, SteelThatIsAlwaysValid) {
  const ValidityLaw always = [](const auto&, double) { return true; };
  const ValidityLaw never = [](const auto&, double) { return false; };
  for (const double mu : {1.3, 1.0 / 0.73, -1.0, -3.0, std::nan("")})
    EXPECT_EQ(outcome_of(assess_steel_validity, always, mu), Outcome::wrong) << mu;
  EXPECT_EQ(outcome_of(assess_steel_validity, never, 0.1), Outcome::wrong);
}

TEST(BrokenLaw, GasThatIsNeverOutsideItsRange) {
  const GasLaw always = [](double temperature, double density) {
    auto state = materials::virial_state(materials::composition_b_gas(), temperature, density);
    state.pressure = state.compressibility * materials::gas_constant * temperature * density * 30.447;
    state.valid = state.compressibility > 0.0;
    return state;
  };
  EXPECT_EQ(outcome_of(assess_gas, always, 300.0, 300.0), Outcome::wrong);   // falls on compression
  EXPECT_EQ(outcome_of(assess_gas, always, 300.0, 1717.0), Outcome::wrong);  // Z < 0, with a pressure
  EXPECT_EQ(outcome_of(assess_gas, always, 3000.0, 300.0), Outcome::held);
}

TEST(BrokenLaw, VirialCoefficientOfOneTerm) {
  const std::function<double(double)> one = [](double t) { return 1.0 - 1.5 / t; };
  EXPECT_EQ(outcome_of(assess_second_virial, one, 1.0), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_second_virial, one, 0.0), Outcome::wrong);
}

TEST(BrokenLaw, AirWithAnotherExponent) {
  const AirLaw other = [](const auto& air, double p) {
    return air.initial_temperature * std::pow(p / air.initial_pressure, 0.2857);
  };
  for (const double ratio : {3.0, 1e5, 0.5})
    EXPECT_EQ(outcome_of(assess_air, other, ratio), Outcome::wrong) << ratio;
  const AirLaw blind = [](const auto& air, double) { return air.initial_temperature; };
  EXPECT_EQ(outcome_of(assess_air, blind, std::nan("")), Outcome::wrong);
}

TEST(BrokenLaw, ConductionThatMakesHeatOrNone) {
  const ConductionLaw none = [](mpm::Conduction&, mpm::Simulation&, double) {};
  const ConductionLaw hotter = [](mpm::Conduction& conduction, mpm::Simulation& simulation, double dt) {
    conduction.advance(simulation, dt);
    for (double& temperature : simulation.bodies_of<materials::Charge>()[0].get().particles.temperature)
      temperature += 1e-6;
  };
  EXPECT_EQ(outcome_of(assess_conduction, none, 1.0), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_conduction, none, 1e4), Outcome::wrong);
  EXPECT_EQ(outcome_of(assess_conduction, hotter, 1.0), Outcome::wrong);
}

TEST(BrokenLaw, DenormalsThatBecomeNotANumberOrTakeLong) {
  const std::function<double(double)> ratio = [](double d) { return d / (d * d); };
  EXPECT_EQ(outcome_of(assess_denormals, ratio), Outcome::wrong);
  const std::function<double(double)> slow = [](double d) {
    volatile double sum = 0.0;
    for (int k = 0; k < 1000000; ++k) sum = sum + d;
    return static_cast<double>(sum);
  };
  EXPECT_EQ(outcome_of(assess_denormals, slow), Outcome::wrong);
}

}  // namespace
}  // namespace launchsafe::verify::law_tests
