// The film of air against closed forms, its orders of convergence, its ledger, and launches.
#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/surface/film_station.hpp"
#include "launchsafe/surface/skin.hpp"
#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

constexpr double rest = 101325.0;  // Pa

/// A trace of `intervals` under a pressure (Pa) of time (s), with friction that grows with t^3 to `friction`
/// J/m3.
trace::BottomTrace film_trace(int intervals, double duration, double friction,
                              const std::function<double(double)>& pressure) {
  trace::BottomTrace trace;
  trace.stations = {{"S1", 0.678, 0.05, 1e-3, false}, {"S2", 0.678, 0.02, 2e-3, false}};
  for (int sample = 0; sample <= intervals; ++sample) {
    const double dt = duration / intervals, t = dt * sample;
    double mean = sample == 0 ? pressure(0.0) : 0.0;
    for (int k = 0; k < 64 && sample > 0; ++k) mean += pressure(t - dt * (k + 0.5) / 64.0) / 64.0;
    trace.time.push_back(t);
    for (auto* values : {&trace.bottom_pressure, &trace.chamber_pressure}) values->push_back(pressure(t));
    for (auto* values : {&trace.mean_bottom_pressure, &trace.mean_chamber_pressure}) values->push_back(mean);
    trace.steps.push_back(200.0 * sample);
    for (auto& closure : trace.friction) {
      for (const double share : {1.0, 0.8}) closure.push_back(share * friction * std::pow(t / duration, 3.0));
    }
  }
  return trace;
}

/// The charge's bottom of the 155 mm shell at a peak of 496 MPa, whose stress follows the load.
trace::BottomTrace film_launch(int intervals, double friction) {
  return film_trace(intervals, 18e-3, friction, [](double t) {
    return rest + 118.6e6 * std::pow(t / 11e-3 * std::exp(1.0 - t / 11e-3), 12.0);
  });
}

SkinModel film_model() {
  SkinModel model = plain_model();
  model.surface.air_model = scene::AirModel::film;
  return model;
}

SkinModel inert_film() {
  SkinModel model = film_model();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
  return model;
}

double film_peak(const SkinModel& model, const trace::BottomTrace& trace, double gap,
                 const FilmNumerics& numerics = {}) {
  return maximum_at_stations(integrate_film(model, trace, gap, numerics).skin, trace).temperature;
}

/// log2 of the ratio of successive differences.
double order_of(double coarse, double middle, double fine) {
  return std::log2(std::abs(coarse - middle) / std::abs(middle - fine));
}

TEST(AirConductivity, IsThatOfTables) {
  // Incropera & DeWitt, Fundamentals of Heat and Mass Transfer, table A.4: W/(m K) at atmospheric pressure.
  EXPECT_NEAR(materials::air_conductivity(300.0), 0.0263, 0.02 * 0.0263);
  EXPECT_NEAR(materials::air_conductivity(400.0), 0.0338, 0.02 * 0.0338);
  EXPECT_NEAR(materials::air_conductivity(600.0), 0.0469, 0.02 * 0.0469);
  EXPECT_NEAR(materials::air_conductivity(1000.0), 0.0667, 0.02 * 0.0667);
}

TEST(Film, WithoutConductivityOfTheWallsIsTheAdiabat) {
  const trace::BottomTrace trace = film_launch(50, 1e6);
  SkinModel model = inert_film();
  model.charge_conductivity = model.base_conductivity = 0.0;
  for (const double gap : {1e-6, 1e-4, 1e-2}) {
    const FilmHistory film = integrate_film(model, trace, gap);
    for (std::size_t k = 0; k < trace.samples(); ++k) {
      const double adiabat = materials::adiabatic_temperature(model.surface.air, trace.bottom_pressure[k]);
      EXPECT_NEAR(film.skin.air_temperature[k], adiabat, 1e-11 * adiabat);
      // The charge has its friction heat and nothing else.
      const double friction = trace.friction[0][2 * k] * model.surface.localisation /
                              (model.charge_density * model.specific_heat);
      EXPECT_NEAR(film.skin.temperature[2 * k], 300.0 + friction, 1e-9);
    }
  }
}

TEST(Film, ThatIsThinIsCompressedIsothermally) {
  // All work on an isothermal gas leaves it as heat: p0 h ln(p/p0).
  const trace::BottomTrace trace = film_trace(200, 18e-3, 0.0, [](double t) { return rest + 7e9 * t; });
  const double gap = 1e-7, expected = rest * gap * std::log(trace.bottom_pressure.back() / rest);
  const FilmHistory film = integrate_film(inert_film(), trace, gap);
  EXPECT_NEAR((film.energy[0].charge + film.energy[0].base) / expected, 1.0, 1e-4);
  EXPECT_NEAR(film.energy[0].work / expected, 1.0, 1e-4);
  for (const double temperature : film.skin.air_temperature) EXPECT_NEAR(temperature, 300.0, 0.01);
}

TEST(Film, HeatsBothWallsAsHalfSpacesUnderAFlux) {
  // From rest as exp(t/tau), air that keeps the temperature of the walls gives p0 h/tau a second as heat: two
  // half-spaces under a constant flux between them, Carslaw & Jaeger 2.9.
  constexpr double tau = 1e-3, duration = 6e-3, gap = 1e-7;
  const trace::BottomTrace trace =
      film_trace(120, duration, 0.0, [](double t) { return rest * std::exp(t / tau); });
  const SkinModel model = inert_film();
  const double flux = model.surface.air.initial_pressure * gap / tau;  // W/m2
  const double charge = std::sqrt(model.charge_conductivity * model.charge_density * model.specific_heat);
  const double base = std::sqrt(model.base_conductivity * model.base_density * model.base_specific_heat);
  const double rise = integrate_film(model, trace, gap).skin.temperature.back() - model.initial_temperature;
  EXPECT_NEAR(rise / (2.0 * flux * std::sqrt(duration / std::numbers::pi) / (charge + base)), 1.0, 5e-3);
}

TEST(FilmColumn, JoinsTwoSolidsAsHalfSpacesInContact) {
  // Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, section 2.15: the face takes the mean by
  // effusivities at once, and each side goes to it as erf(x/(2 sqrt(alpha t))).
  const SkinModel model = inert_film();
  FilmNumerics numerics;
  numerics.charge_cells = 80;
  numerics.base_cells = 80;
  const double duration = 18e-3, charge = 300.0, base = 400.0;
  const auto grid = detail::film_grid(model, 1e-10, duration, numerics);
  detail::FilmColumn column(grid, model.surface.air, charge, base);
  constexpr int steps = 2000;
  for (int k = 0; k < steps; ++k) column.step(duration / steps, {rest, rest, rest}, 0.0);

  const double volumetric = model.charge_density * model.specific_heat;
  const double in_charge = std::sqrt(model.charge_conductivity * volumetric);
  const double in_base = std::sqrt(model.base_conductivity * model.base_density * model.base_specific_heat);
  const double face = (in_charge * charge + in_base * base) / (in_charge + in_base);
  EXPECT_NEAR(column.charge_surface(), face, 1e-2);
  EXPECT_NEAR(column.base_surface(), face, 1e-2);
  double x = 0.0;
  for (std::size_t i = grid.air_begin; i-- > 0;) {
    const double dx = grid.capacity[i] / volumetric, middle = x + 0.5 * dx;
    const double scale = 2.0 * std::sqrt(model.charge_conductivity / volumetric * duration);
    EXPECT_NEAR(column.temperature(i), face + (charge - face) * std::erf(middle / scale), 0.1);
    x += dx;
  }
}

TEST(Film, ConservesEnergyToRoundOff) {
  for (const double gap : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
    for (const double friction : {0.0, 1.1e6}) {
      const FilmHistory film = integrate_film(film_model(), film_launch(300, friction), gap);
      EXPECT_LE(film.skin.energy_residual, 1e-12) << gap;
      ASSERT_EQ(film.energy.size(), 2u);
      EXPECT_GT(film.energy[0].work, 0.0);
    }
  }
}

TEST(Film, ConvergesWithSecondOrderInSpace) {
  const trace::BottomTrace trace = film_launch(100, 1.1e6);
  for (const double gap : {1e-4, 4e-3}) {
    const auto at = [&](std::size_t finer) {
      FilmNumerics numerics{20 * finer, 16 * finer, 12 * finer, 1e-7};
      return integrate_film(inert_film(), trace, gap, numerics).skin.temperature[2 * 60];
    };
    const double order = order_of(at(1), at(2), at(4));
    RecordProperty("order_at_" + std::to_string(gap), std::to_string(order));
    EXPECT_NEAR(order, 2.0, 0.25) << gap;
  }
}

TEST(Film, ConvergesWithSecondOrderInTime) {
  // Also in a film so thin that it only follows the walls. The pressure rises with t^2: without a jump of its
  // slope at the begin, after which a surface warms as the root of time.
  constexpr double duration = 2e-3;
  const auto pressure = [](double time) { return rest + 3e6 * time * time / (duration * duration); };
  const SkinModel model = inert_film();
  for (const double gap : {1e-6, 1e-4, 1e-3, 1e-2}) {
    const detail::FilmGrid grid = detail::film_grid(model, gap, duration, {});
    const auto at = [&](int steps) {
      detail::FilmColumn column(grid, model.surface.air, 300.0, 300.0);
      const double h = duration / steps;
      for (int k = 0; k < steps; ++k)
        column.step(h, {pressure(h * k), pressure(h * (k + detail::inner_stage)), pressure(h * (k + 1))},
                    0.0);
      return column.charge_surface() - 300.0;
    };
    const double coarse = at(40), middle = at(80), fine = at(160), order = order_of(coarse, middle, fine);
    RecordProperty("order_at_" + std::to_string(gap), std::to_string(order));
    EXPECT_NEAR(order, 2.0, 0.3) << gap;
  }
}

TEST(Film, StaysFiniteAndMonotoneUnderAnyLoad) {
  for (const double rise : {1e-4, 1e-3, 1e-2}) {
    for (const double peak : {1e6, 118e6, 1e9}) {
      const trace::BottomTrace trace =
          film_trace(40, 1.2 * rise, 0.0, [&](double t) { return rest + peak * std::min(1.0, t / rise); });
      double before = 300.0;
      for (const double gap : {1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const FilmHistory film = integrate_film(inert_film(), trace, gap);
        double hottest = 300.0;
        for (std::size_t k = 0; k < trace.samples(); ++k) {
          const double surface = film.skin.temperature[2 * k], air = film.skin.air_temperature[k];
          const double adiabat =
              materials::adiabatic_temperature(inert_film().surface.air, trace.bottom_pressure[k]);
          ASSERT_TRUE(std::isfinite(surface) && std::isfinite(air)) << gap;
          EXPECT_GE(surface, 300.0 - 1e-6) << gap;
          EXPECT_LE(surface, adiabat + 1e-6) << gap;
          EXPECT_LE(air, adiabat + 1e-6) << gap;
          hottest = std::max(hottest, surface);
        }
        EXPECT_GE(hottest, before - 2e-2) << gap;  // more air warms more, up to what reaches the wall in time
        EXPECT_LE(film.skin.energy_residual, 1e-11);
        before = hottest;
      }
    }
  }
}

TEST(Film, DependsOnTheLoadAndNotOnItsSamples) {
  for (const double rise : {1e-4, 1e-2})
    for (const double peak : {1e6, 1e8, 1e9})
      for (const double gap : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
        const auto warmed = [&](int intervals) {
          const auto pressure = [&](double t) { return rest + (peak - rest) * std::min(1.0, t / rise); };
          const trace::BottomTrace trace = film_trace(intervals, 1.5 * rise, 0.0, pressure);
          return integrate_film(inert_film(), trace, gap).skin.temperature.back() - 300.0;
        };
        const double few = warmed(150);
        EXPECT_NEAR(warmed(300), few, 1e-3 * few + 1e-6) << rise << ' ' << peak << ' ' << gap;
      }
}

TEST(Film, WarmsTheSurfaceAsATrialDid) {
  // Without friction, at 496 MPa: 0.4, 2 and 44 K at 0.1, 0.4 and 4 mm by a trial of its own (model section
  // 12); here the bottom's stress is the load's shape.
  const trace::BottomTrace trace = film_launch(300, 0.0);
  EXPECT_NEAR(film_peak(inert_film(), trace, 1e-4) - 300.0, 0.4, 0.1);
  EXPECT_NEAR(film_peak(inert_film(), trace, 4e-4) - 300.0, 2.0, 0.4);
  EXPECT_NEAR(film_peak(inert_film(), trace, 4e-3) - 300.0, 44.0, 4.0);
}

TEST(Film, WithoutGapIsFrictionAlone) {
  const trace::BottomTrace trace = film_launch(100, 1.1e6);
  SkinModel reservoir = film_model();
  reservoir.surface.air_model = scene::AirModel::reservoir;
  const SkinHistory film = integrate_skin(film_model(), trace, 0.0);
  EXPECT_EQ(film.temperature, integrate_skin(reservoir, trace, 0.0).temperature);
}

TEST(Film, LiesOnTheBodyUnderTheCharge) {
  scene::Scene scene;
  scene.bodies = {{"wall", "steel", 0.0, 0.5, 0.06, 0.07},
                  {"charge", "charge", 0.1, 0.5, 0.0, 0.06},
                  {"base", "elastic", 0.5, 0.6, 0.0, 0.07}};
  auto& elastic = scene.parameters<materials::LinearElastic>();
  elastic.conductivity = 55.0;
  elastic.specific_heat = 430.0;
  elastic.density = 7900.0;
  scene.charge().conductivity = 0.3;
  const SkinModel model = skin_model(scene);
  EXPECT_EQ(model.base_conductivity, 55.0);
  EXPECT_EQ(model.base_specific_heat, 430.0);
  EXPECT_EQ(model.base_density, 7900.0);
  EXPECT_EQ(model.charge_conductivity, 0.3);
  scene.bodies.pop_back();
  EXPECT_EQ(skin_model(scene).base_conductivity, scene.steel().strength.conductivity);
}

TEST(Film, GoesThroughTheSkinsOwnEntry) {
  const trace::BottomTrace trace = film_launch(100, 1.1e6);
  const SkinHistory skin = integrate_skin(film_model(), trace, 1e-3);
  EXPECT_EQ(skin.temperature, integrate_film(film_model(), trace, 1e-3).skin.temperature);
  EXPECT_EQ(skin.gap, 1e-3);
  EXPECT_EQ(skin.time, trace.time);
  const trace::BottomTrace coarse = trace::thinned(film_launch(600, 1.1e6));
  EXPECT_NEAR(film_peak(film_model(), coarse, 1e-3), film_peak(film_model(), film_launch(600, 1.1e6), 1e-3),
              0.05);
}

TEST(FilmIgnition, ComesWhereTheInertSurfaceReachesTheTrigger) {
  const trace::BottomTrace trace = film_launch(300, 0.0);
  const FilmHistory inert = integrate_film(inert_film(), trace, 1e-2);
  const Maximum hottest = maximum_at_stations(inert.skin, trace);
  for (const double above : {-5.0, -0.5, 0.5}) {
    SkinModel model = film_model();
    model.kinetics.frequency = 0.0;  // the trigger alone
    model.kinetics.ignition_temperature = hottest.temperature + above;
    model.kinetics.burnt_temperature = 784.0;
    const SkinHistory film = integrate_film(model, trace, 1e-2).skin;
    ASSERT_EQ(film.ignition.has_value(), above < 0.0) << above;
    if (!film.ignition) continue;
    EXPECT_EQ(film.ignition->cause, IgnitionCause::trigger);
    EXPECT_EQ(film.ignition->chemical_share, 0.0);
    std::size_t k = 0;
    while (inert.skin.temperature[2 * k] < model.kinetics.ignition_temperature) ++k;
    const double below = inert.skin.temperature[2 * k - 2], over = inert.skin.temperature[2 * k];
    const double crossing = trace.time[k - 1] + (trace.time[k] - trace.time[k - 1]) *
                                                    (model.kinetics.ignition_temperature - below) /
                                                    (over - below);
    EXPECT_NEAR(film.ignition->time, crossing, 2e-6);
    EXPECT_EQ(maximum_at_stations(film, trace).temperature, 784.0);
  }
}

TEST(FilmIgnition, OfHotMatterTakesItsInductionTime) {
  // Everything at 700 K and nothing moves: the adiabatic induction of model section 10.
  SkinModel model = film_model();
  model.kinetics.activation_temperature = 2.7e4;
  model.kinetics.ignition_temperature = 1e9;
  model.kinetics.burnt_temperature = 2e9;
  model.initial_temperature = model.surface.air.initial_temperature = 700.0;
  model.charge_conductivity = 0.0;
  const trace::BottomTrace trace = film_trace(20, 2e-4, 0.0, [](double) { return rest; });
  const SkinHistory film = integrate_film(model, trace, 1e-4).skin;
  ASSERT_TRUE(film.ignition.has_value());
  EXPECT_EQ(film.ignition->cause, IgnitionCause::arrhenius);
  EXPECT_NEAR(film.ignition->time / 1.645534e-4, 1.0, 1e-3);
}

TEST(Film, KnowsTheDepthThatTheBaseDoesNotCool) {
  // Below what the base cools the charge is as hot as friction alone makes it without a gap.
  const trace::BottomTrace trace = film_launch(300, 1.1e6);
  const double alone = maximum_at_stations(integrate_skin(inert_film(), trace, 0.0), trace).temperature;
  EXPECT_NEAR(integrate_film(inert_film(), trace, 1e-6).skin.hottest_depth, alone, 0.2);
}

TEST(FilmIgnition, ByFrictionInsideIsThatOfFrictionAlone) {
  // The base cools the surface, not the depth.
  const trace::BottomTrace trace = film_launch(300, 3.3e6);
  const SkinHistory alone = integrate_skin(film_model(), trace, 0.0);
  const SkinHistory film = integrate_skin(film_model(), trace, 1e-4);
  ASSERT_TRUE(alone.ignition.has_value() && film.ignition.has_value());
  EXPECT_NEAR(film.ignition->time, alone.ignition->time, 1e-5);  // samples are 6e-5 s apart
  EXPECT_EQ(film.ignition->cause, alone.ignition->cause);
  EXPECT_LE(film.energy_residual, 1e-12);
  EXPECT_EQ(film.temperature[2 * 299], 784.0);
}

TEST(FilmIgnition, ByRunawayBesideColdWallsKeepsTheLedger) {
  // Without the trigger: inside, where no wall cools, it runs away as under friction alone or before.
  SkinModel model = film_model();
  model.kinetics.ignition_temperature = 1e9;
  model.kinetics.burnt_temperature = 2e9;
  const trace::BottomTrace trace = film_launch(300, 4.4e6);
  const SkinHistory alone = integrate_skin(model, trace, 0.0);
  for (const double gap : {1e-4, 1e-2}) {
    const FilmHistory film = integrate_film(model, trace, gap);
    ASSERT_TRUE(alone.ignition.has_value() && film.skin.ignition.has_value());
    EXPECT_EQ(film.skin.ignition->cause, IgnitionCause::arrhenius);
    EXPECT_LE(film.skin.ignition->time, alone.ignition->time + 1e-6) << gap;
    EXPECT_GT(film.energy[0].reaction, 0.0);
    EXPECT_LE(film.skin.energy_residual, 1e-11);
  }
}

}  // namespace
