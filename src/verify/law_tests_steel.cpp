// Steel: Johnson-Cook at extreme rates, temperatures and stresses; Mie-Grueneisen at the Hugoniot's pole.
#include "law_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::law_tests {

namespace {

constexpr double steel_round_off = 2.3e-16;
const materials::JohnsonCookParameters strength;
const materials::MieGruneisenParameters pressure_law;

/// The laws on one number, or as a run calls them, on a Pack.
template <class Number>
materials::JohnsonCookReturn<double> return_to_yield(const materials::JohnsonCookParameters& k,
                                                     math::Deviator<double> trial, double plastic_strain,
                                                     double temperature, double dt) {
  const auto result =
      materials::johnson_cook_return<Number>(k, {Number(trial.rr), Number(trial.xx), Number(trial.rx)},
                                             Number(plastic_strain), Number(temperature), Number(dt));
  return {{first_of(result.stress.rr), first_of(result.stress.xx), first_of(result.stress.rx)},
          first_of(result.plastic_strain_increment),
          first_of(result.plastic_work)};
}

template <class Number>
double flow_stress(const materials::JohnsonCookParameters& k, double strain, double rate,
                   double temperature) {
  return first_of(
      materials::johnson_cook_flow_stress<Number>(k, Number(strain), Number(rate), Number(temperature)));
}

template <class Number>
materials::MieGruneisenState<double> compress_steel(const materials::MieGruneisenParameters& m, double mu0,
                                                    double p0, double energy0, double mu1) {
  const auto state = materials::mie_gruneisen_compress<Number>(m, Number(mu0), Number(p0), Number(energy0),
                                                               Number(mu1), Number(0.0));
  return {first_of(state.pressure), first_of(state.energy)};
}

bool is_valid(const materials::MieGruneisenParameters& m, double mu) {
  return static_cast<bool>(materials::mie_gruneisen_is_valid(m, mu));
}

/// Energy (J/kg) at compression mu1 by Runge-Kutta's fourth order in ln(rho): de/dln(rho) = p/rho.
double fine_energy(double mu0, double energy0, double mu1) {
  constexpr int steps = 20000;
  const double h = std::log((1.0 + mu1) / (1.0 + mu0)) / steps;
  const auto slope = [&](double logarithm, double energy) {
    const double density_ratio = (1.0 + mu0) * std::exp(logarithm);
    return materials::mie_gruneisen_pressure(pressure_law, density_ratio - 1.0, energy) /
           (pressure_law.density * density_ratio);
  };
  double energy = energy0;
  for (int k = 0; k < steps; ++k) {
    const double x = k * h;
    const double a = slope(x, energy), b = slope(x + 0.5 * h, energy + 0.5 * h * a),
                 c = slope(x + 0.5 * h, energy + 0.5 * h * b), d = slope(x + h, energy + h * c);
    energy += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return energy;
}

const double melting = strength.melting_temperature;
constexpr double strains[] = {0.0, 1e-300, 1e-6, 0.1, 10.0};
constexpr double trials[] = {0.0, 1e-140, 1.0, 1e6, 7.9e8, 8e8, 1e9, 1e10, 1e12, 1e15, 1e18};
constexpr double durations[] = {1e-15, 1e-12, 1e-9, 1e-7, 1e-3, 1.0, 1e9};

void assess_all_returns(Bounds& bounds, double temperature) {
  for (const ReturnLaw& law : {ReturnLaw(return_to_yield<double>), ReturnLaw(return_to_yield<math::Pack>)})
    for (const double q : trials)
      for (const double strain : strains)
        for (const double dt : durations) assess_return(bounds, law, q, strain, temperature, dt);
}

void assess_unknown_state(Bounds& bounds) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ReturnLaw& law : {ReturnLaw(return_to_yield<double>), ReturnLaw(return_to_yield<math::Pack>)}) {
    assess_return(bounds, law, nan, 0.0, 300.0, 1e-7);
    assess_return(bounds, law, 1e9, nan, 300.0, 1e-7);
    assess_return(bounds, law, 1e9, 0.0, nan, 1e-7);
    assess_return(bounds, law, 1e8, 0.0, nan, 1e-7);
  }
}

void add_strength(LawTests& tests) {
  const std::string group = "stiff: Johnson-Cook";
  for (const double rate : {0.0, 1e-12, 1.0, 1e9}) {
    tests.push_back(
        {group, fmt::format("flow stress at {:g} 1/s, 200 K to beyond melting", rate),
         "It is the published formula to 1e-12, with the rate factor 1 below the reference rate and 0 from "
         "melting on.",
         [rate](Bounds& bounds) {
           for (const FlowLaw& law : {FlowLaw(flow_stress<double>), FlowLaw(flow_stress<math::Pack>)})
             for (const double strain : strains)
               for (const double t : {200.0, 298.0, 300.0, 1000.0, melting - 1e-9, melting, 5000.0})
                 assess_flow_stress(bounds, law, strain, rate, t);
         }});
  }
  struct Heat {
    const char* name;
    double temperature;
  };
  for (const Heat heat :
       {Heat{"0 K", 0.0}, Heat{"298 K", 298.0}, Heat{"1000 K", 1000.0},
        Heat{"1 K below melting", melting - 1.0}, Heat{"1 nK below melting", melting - 1e-9},
        Heat{"melting", melting}, Heat{"10000 K", 1e4}}) {
    tests.push_back(
        {group, fmt::format("return at {}, trial stress 0 to 1e18 Pa, steps 1 fs to 1e9 s", heat.name),
         "The returned stress lies on the yield surface of its own strain and rate, to 1e-9 of flow stress "
         "and trial (counted up to 0.8 TPa) and round-off; plastic work is that stress times the strain, "
         "never negative; elastic states are left alone.",
         [temperature = heat.temperature](Bounds& bounds) { assess_all_returns(bounds, temperature); }});
  }
  tests.push_back({group, "stress, strain or temperature not a number",
                   "The result is no number either; above all the steel is not taken to be elastic.",
                   assess_unknown_state});
}

void add_pressure(LawTests& tests) {
  const std::string group = "extreme: Mie-Grueneisen";
  const double bound = materials::largest_compression(pressure_law);
  struct Path {
    const char* name;
    double mu0, mu1;
  };
  for (const Path path :
       {Path{"rest to half the pole", 0.0, 0.5 / 0.73}, Path{"rest to the guard", 0.0, bound},
        Path{"rest to a hundredfold volume", 0.0, -0.99},
        Path{"a tenfold volume to double density", -0.9, 1.0},
        Path{"double density to a tenfold volume", 1.0, -0.9}}) {
    tests.push_back({group, fmt::format("{} in 1 to 10000 steps", path.name),
                     "The energy is that of de = -p dv to the second order of the step; the pressure is the "
                     "law's own at that energy.",
                     [path](Bounds& bounds) {
                       for (const int steps : {1, 10, 100, 10000}) {
                         assess_steel_pressure(bounds, compress_steel<double>, path.mu0, path.mu1, steps);
                         assess_steel_pressure(bounds, compress_steel<math::Pack>, path.mu0, path.mu1, steps);
                       }
                     }});
  }
  tests.push_back({group, "at the pole, beyond it, and densities that are none",
                   "Every such state is flagged (run results count it as the Hugoniot guard), and none below "
                   "the guard is.",
                   [bound](Bounds& bounds) {
                     const double nan = std::numeric_limits<double>::quiet_NaN();
                     const double infinity = std::numeric_limits<double>::infinity();
                     for (const double mu : {-1.0 + 1e-12, -0.5, 0.0, 0.5, bound, bound * (1.0 + 1e-12),
                                             1.0 / 0.73, 2.0, 1e9, infinity, -1.0, -2.0, -infinity, nan})
                       assess_steel_validity(bounds, is_valid, mu);
                   }});
}

}  // namespace

void assess_flow_stress(Bounds& bounds, const FlowLaw& law, double plastic_strain, double plastic_rate,
                        double temperature) {
  const auto& k = strength;
  const long double homologous =
      std::clamp<long double>((static_cast<long double>(temperature) - k.room_temperature) /
                                  (k.melting_temperature - k.room_temperature),
                              0.0L, 1.0L);
  const long double hard = k.a + k.b * std::pow(static_cast<long double>(plastic_strain), k.n);
  const long double fast =
      1.0L + k.c * std::log(std::max<long double>(plastic_rate / k.reference_rate, 1.0L));
  const double exact =
      static_cast<double>(hard * fast * (1.0L - std::pow(homologous, static_cast<long double>(k.m))));
  const double found = law(k, plastic_strain, plastic_rate, temperature);
  bounds.at_most("distance from the formula, share of A", std::abs(found - exact) / k.a, 1e-12);
  bounds.never("molten steel bears stress", temperature >= k.melting_temperature && found > 0.0);
}

void assess_return(Bounds& bounds, const ReturnLaw& law, double q, double plastic_strain, double temperature,
                   double dt) {
  const auto& k = strength;
  // A direction with all components, of von Mises 1.
  const math::Deviator<double> shape{0.3, -0.7, 0.4};
  const math::Deviator<double> trial = (q / math::von_mises(shape)) * shape;
  const auto result = law(k, trial, plastic_strain, temperature, dt);
  const double stress = math::von_mises(result.stress), strain = result.plastic_strain_increment;
  if (std::isnan(q + plastic_strain + temperature)) {
    bounds.never("a state that is unknown gives a stress", std::isfinite(stress));
    bounds.caught("NaN in, NaN out");
    return;
  }
  bounds.never("a number is not finite", !std::isfinite(stress + strain + result.plastic_work));
  bounds.never("the plastic strain shrinks", strain < 0.0);
  bounds.never("plastic work is negative", result.plastic_work < 0.0);
  const double yield = materials::johnson_cook_flow_stress(k, plastic_strain, 0.0, temperature);
  if (q <= yield) {
    bounds.at_most("elastic state changed, Pa", std::abs(stress - q), 4.0 * steel_round_off * q);
    bounds.never("an elastic state flows", strain > 0.0);
    return;
  }
  const double flow =
      materials::johnson_cook_flow_stress(k, plastic_strain + strain, strain / dt, temperature);
  // q - 3 G d cancels: round-off of both remains, also in the argument of the flow stress.
  bounds.at_most(
      "distance from the yield surface, share of flow stress and round-off of the trial",
      std::abs(stress - flow) / (1e-9 * flow + 1e-9 * std::min(q, 1e3 * k.a) + 8.0 * steel_round_off * q),
      1.0);
  bounds.at_most("plastic work against stress times strain, share",
                 std::abs(result.plastic_work - stress * strain) / (q * strain + 1e-300), 1e-12);
  const auto across = (1.0 / q) * (result.stress - (stress / math::von_mises(shape)) * shape);
  bounds.at_most("stress turned by the return, share of the trial", math::von_mises(across), 1e-14);
}

void assess_steel_pressure(Bounds& bounds, const SteelPressureLaw& law, double mu0, double mu1, int steps) {
  const auto& m = pressure_law;
  const double energy0 = 0.0;
  materials::MieGruneisenState<double> state{materials::mie_gruneisen_pressure(m, mu0, energy0), energy0};
  double mu = mu0;
  const double ratio = std::pow((1.0 + mu1) / (1.0 + mu0), 1.0 / steps);
  for (int k = 1; k <= steps; ++k) {
    const double next = k == steps ? mu1 : (1.0 + mu) * ratio - 1.0;
    state = law(m, mu, state.pressure, state.energy, next);
    mu = next;
  }
  const double exact = fine_energy(mu0, energy0, mu1);
  bounds.at_most("distance from the energy of de = -p dv, share", std::abs(state.energy / exact - 1.0), 2e-2);
  const double own = materials::mie_gruneisen_pressure(m, mu1, state.energy);
  bounds.at_most("pressure against the law's own at that energy, share", std::abs(state.pressure / own - 1.0),
                 1e-10);
}

void assess_steel_validity(Bounds& bounds, const ValidityLaw& law, double mu) {
  const bool sound = mu > -1.0 && mu <= materials::largest_compression(pressure_law);
  bounds.never("a state without meaning passes as valid", !sound && law(pressure_law, mu));
  bounds.never("a sound state is flagged", sound && !law(pressure_law, mu));
  if (!sound) bounds.caught("flagged as invalid");
}

LawTests steel_tests() {
  LawTests tests;
  add_strength(tests);
  add_pressure(tests);
  return tests;
}

}  // namespace launchsafe::verify::law_tests
