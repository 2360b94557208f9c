// Columns of a gap that closes: their account, and the limits of no conduction and of much.
#include "launchsafe/surface/gap_columns.hpp"

#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

SkinModel inert_model() {
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
  return model;
}

/// Pressures (Pa) of an interval.
struct Pushed {
  double mean, end;
};

/// Closes air from one opening (m) to another in a time (s), as contact does: by an isentrope, with the
/// exchange that the air states, in small steps.
Pushed push(const EnclosedAir& air, double covolume, double begin, double end, double time) {
  constexpr int steps = 50;
  double volume = air.volume, mean = 0.0, now = air.pressure;
  const auto at = [&](double h) { return air.pressure * std::pow(volume / (h - covolume), air.exponent); };
  for (int step = 1; step <= steps; ++step) {
    const double before = now, opening = std::lerp(begin, end, double(step) / steps);
    const double middle = opening - 0.5 * (end - begin) / steps;
    const double left = std::exp(-time / steps * air.exchange / middle);
    volume *= left + (1.0 - left) * air.pressure * air.volume_at_walls / (at(middle) * (middle - covolume));
    now = at(opening);
    mean += 0.5 * (before + now) / steps;
  }
  return {mean, now};
}

/// Closes a gap (m) by a part of itself in a time (s).
EnclosedAir close(GapColumns& columns, double gap, double part, double time, int intervals) {
  EnclosedAir air = columns.fit(0, gap);
  for (int i = 0; i < intervals; ++i) {
    const auto opening = [&](int n) { return gap * (1.0 - part * n / intervals); };
    const Pushed pushed =
        push(air, columns[0].column().covolume(), opening(i), opening(i + 1), time / intervals);
    columns.advance(0, time / intervals, air.pressure, pushed.end, pushed.mean, 0.0);
    air = columns.fit(0, opening(i + 1));
  }
  return air;
}

TEST(GapColumns, AreOnTheAdiabatWhereTheyCloseAtOnce) {
  const SkinModel model = inert_model();
  GapColumns columns(model, 1, 1e-3, 1e-2);
  const EnclosedAir air = close(columns, 1e-3, 0.9, 1e-12, 100);
  EXPECT_NEAR(air.pressure / 101325.0, std::pow(10.0, 1.4), 1e-4 * std::pow(10.0, 1.4));
  EXPECT_NEAR(columns[0].mean_air(), 300.0 * std::pow(10.0, 0.4), 0.1);
}

TEST(GapColumns, AreOnTheIsentropeOfHotAndDenseAirWhereTheyCloseAtOnce) {
  // R ln(p/p0) is the integral of c_p(T)/T, here by Simpson's rule; p (h - b m) = m R T.
  SkinModel model = inert_model();
  model.surface.air = materials::hot_and_dense(model.surface.air);
  const double gas_constant = 1005.0 * 0.4 / 1.4;
  const auto integrand = [&](double logarithm) {
    const double x = 3055.6 / std::exp(logarithm);
    return 1005.0 + gas_constant * x * x * std::exp(x) / std::pow(std::exp(x) - 1.0, 2);
  };
  GapColumns columns(model, 1, 1e-3, 1e-2);
  const EnclosedAir air = columns.fit(0, 1e-5);
  const double temperature = columns[0].mean_air();
  EXPECT_GT(temperature, 1300.0);
  EXPECT_LT(temperature, 300.0 * std::pow(100.0, 0.4));
  constexpr int parts = 1000;
  const double width = std::log(temperature / 300.0) / parts;
  double entropy = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double at = std::log(300.0) + i * width;
    entropy += width / 6.0 * (integrand(at) + 4.0 * integrand(at + 0.5 * width) + integrand(at + width));
  }
  EXPECT_NEAR(std::log(air.pressure / 101325.0), entropy / gas_constant, 1e-9);
  const double mass = 1e-3 / (gas_constant * 300.0 / 101325.0 + 1.03e-3);
  EXPECT_NEAR(air.pressure * (1e-5 - 1.03e-3 * mass), mass * gas_constant * temperature, 1e-9 * 101325.0);
  EXPECT_NEAR(columns[0].column().covolume(), 1.03e-3 * mass, 1e-15);
}

TEST(GapColumns, TakeTheWorkOfTheirPressure) {
  // The integral of V dp over an adiabatic change, of free volume and covolume.
  SkinModel model = inert_model();
  model.surface.air = materials::hot_and_dense(model.surface.air);
  GapColumns columns(model, 1, 1e-3, 1e-2);
  EnclosedAir air = columns.fit(0, 1e-3);
  double work = 0.0;
  constexpr int parts = 4000;
  for (int i = 1; i <= parts; ++i) {
    const EnclosedAir before = air;
    air = columns.fit(0, 1e-3 * std::pow(0.01, double(i) / parts));
    work += (0.5 * (before.volume + air.volume) + columns[0].column().covolume()) *
            (air.pressure - before.pressure);
  }
  EXPECT_NEAR(columns[0].energy().work, work, 1e-5 * work);
}

TEST(GapColumns, KeepTheTemperatureOfTheirWallsWhereTheyAreThin) {
  // p h is constant there, and the walls are not warmed by the little heat.
  const SkinModel model = inert_model();
  GapColumns columns(model, 1, 1e-5, 1e-2);
  const EnclosedAir air = close(columns, 1e-5, 0.5, 1e-2, 400);
  EXPECT_NEAR(air.pressure, 2.0 * 101325.0, 1e-3 * 101325.0);
  EXPECT_NEAR(columns[0].mean_air(), 300.0, 0.1);
}

TEST(GapColumns, AccountForTheirHeatToRoundOff) {
  SkinModel model = inert_model();
  const double steel = model.base_conductivity;
  for (const auto& [conductivity, real] : {std::pair{steel, false}, {steel, true}, {0.0, true}}) {
    model.base_conductivity = conductivity;
    if (real) model.surface.air = materials::hot_and_dense(model.surface.air);
    GapColumns columns(model, 1, 4e-4, 1e-2);
    close(columns, 4e-4, 0.97, 1e-4, 200);
    const FilmEnergy& energy = columns[0].energy();
    EXPECT_GT(energy.work, 10.0);
    EXPECT_LT(energy.residual(), 1e-9);
    if (!(conductivity > 0.0)) {
      EXPECT_DOUBLE_EQ(energy.base, 0.0);
    }
  }
}

TEST(GapColumns, MeltBeforeTheyGetWarmer) {
  // Friction heats the whole depth by 100 K: 53 K of them to 353 K, then melting takes 22 K. After 60 K it
  // has taken 7 K, but beside the air, which lags behind; at the end all of it.
  SkinModel model = inert_model();
  model.base_conductivity = 0.0;
  model.surface.melts = true;
  model.heat_of_melting = 22.0 * model.specific_heat;
  GapColumns columns(model, 1, 1e-6, 1e-2);
  constexpr int intervals = 100;
  EnclosedAir air = columns.fit(0, 1e-6);
  const auto melted_share = [&] { return -columns[0].energy().reaction / columns[0].energy().friction; };
  for (int i = 0; i < intervals; ++i) {
    columns.advance(0, 1e-4, air.pressure, air.pressure, air.pressure, 1e4);
    air = columns.fit(0, 1e-6);
    if (i + 1 == 53) {
      EXPECT_LT(melted_share(), 1e-3);
    }
    if (i + 1 == 60) {
      EXPECT_NEAR(melted_share(), 7.0 / 60.0, 1e-3);
    }
  }
  EXPECT_NEAR(melted_share(), 0.22, 1e-9);
  EXPECT_NEAR(columns[0].hottest(), 300.0 + 100.0 - 22.0, 0.5) << "the air is compressed, and warmer";
  EXPECT_LT(columns[0].energy().residual(), 1e-9);
}

TEST(GapColumns, AreOfSecondOrderInTheirIntervals) {
  SkinModel model = inert_model();
  model.surface.air = materials::hot_and_dense(model.surface.air);
  const auto hottest = [&](int intervals) {
    GapColumns columns(model, 1, 4e-4, 1e-2, {.tolerance = 1e-7});
    close(columns, 4e-4, 0.95, 5e-5, intervals);
    return columns[0].hottest();
  };
  const double exact = hottest(1600);
  EXPECT_GT(exact, 310.0);
  // By a factor of 2 in the length of intervals, on average over four of them.
  const double order = std::log2(std::abs(hottest(50) - exact) / std::abs(hottest(200) - exact)) / 2.0;
  EXPECT_GT(order, 1.6);
}

/// Of columns by area.
double sum_of(const GapColumns& columns, const std::vector<double>& areas, double FilmEnergy::*part) {
  double sum = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) sum += areas[i] * columns[i].energy().*part;
  return sum;
}

/// Closes two columns that share their air from 0.4 mm, the first by a part, the second by another, in a time
/// (s); the first is heated by friction (K/s).
EnclosedAir close_together(GapColumns& columns, const std::vector<double>& areas, double first, double second,
                           double time, int intervals, double heating) {
  constexpr double gap = 4e-4;
  const auto mean = [&](double of_first, double of_second) {
    return (areas[0] * of_first + areas[1] * of_second) / (areas[0] + areas[1]);
  };
  EnclosedAir air = columns.fit_together(101325.0, {gap, gap}, areas);
  double before = gap;
  for (int i = 1; i <= intervals; ++i) {
    const double part = double(i) / intervals;
    const std::vector<double> openings{gap * (1.0 - first * part), gap * (1.0 - second * part)};
    const double after = mean(openings[0], openings[1]);
    const double covolume = mean(columns[0].column().covolume(), columns[1].column().covolume());
    const Pushed pushed = push(air, covolume, before, after, time / intervals);
    for (std::size_t column : {0u, 1u})
      columns.advance(column, time / intervals, air.pressure, pushed.end, pushed.mean,
                      column == 0 ? heating : 0.0);
    air = columns.fit_together(pushed.end, openings, areas);
    before = after;
  }
  return air;
}

TEST(GapColumns, ThatShareTheirAirAreOnOneAdiabat) {
  // p V^1.4 of both together; without conduction all of it has one temperature.
  const std::vector<double> areas{1.0, 2.0};
  GapColumns columns(inert_model(), 2, 4e-4, 1e-2);
  const EnclosedAir air = close_together(columns, areas, 0.95, 0.2, 1e-18, 200, 0.0);
  const double ratio = 3.0 / (0.05 + 2.0 * 0.8);
  EXPECT_NEAR(air.pressure / 101325.0, std::pow(ratio, 1.4), 1e-9 * std::pow(ratio, 1.4));
  for (std::size_t column : {0u, 1u})
    EXPECT_NEAR(columns[column].mean_air(), 300.0 * std::pow(ratio, 0.4), 1e-4);
  // Work and heat capacity of all of it: m c_p = 3.5 p0 V0/T0.
  const double work = 3.5 * 101325.0 * 3.0 * 4e-4 * (std::pow(ratio, 0.4) - 1.0);
  EXPECT_NEAR(sum_of(columns, areas, &FilmEnergy::work), work, 1e-6 * work);
  EXPECT_NEAR(sum_of(columns, areas, &FilmEnergy::gas), work, 1e-6 * work);
  EXPECT_LT(columns[0].energy().inflow, 0.0);
  EXPECT_NEAR(sum_of(columns, areas, &FilmEnergy::inflow), 0.0, 1e-12 * work);
}

TEST(GapColumns, ThatShareTheirAirAccountForTheHeatThatFlowsWithIt) {
  const std::vector<double> areas{1.0, 0.3};
  SkinModel model = inert_model();
  model.surface.air = materials::hot_and_dense(model.surface.air);
  for (const double conductivity : {model.base_conductivity, 0.0}) {
    model.base_conductivity = conductivity;
    GapColumns columns(model, 2, 4e-4, 1e-2);
    close_together(columns, areas, 0.97, 0.5, 1e-4, 400, 1e6);
    const double work = sum_of(columns, areas, &FilmEnergy::work);
    EXPECT_GT(work, 10.0);
    for (std::size_t column : {0u, 1u}) EXPECT_LT(columns[column].energy().residual(), 1e-9);
    EXPECT_GT(std::abs(columns[0].energy().inflow), 0.1 * work);
    EXPECT_NEAR(sum_of(columns, areas, &FilmEnergy::inflow), 0.0, 1e-9 * work);
    const double heat = sum_of(columns, areas, &FilmEnergy::charge) +
                        sum_of(columns, areas, &FilmEnergy::base) + sum_of(columns, areas, &FilmEnergy::gas);
    EXPECT_NEAR(heat, work + sum_of(columns, areas, &FilmEnergy::friction), 1e-9 * heat);
  }
}

TEST(GapColumns, ThatShareTheirAirAreThoseThatKeepItWhereAllCloseAlike) {
  SkinModel model = inert_model();
  model.surface.air = materials::hot_and_dense(model.surface.air);
  GapColumns together(model, 2, 4e-4, 1e-2), alone(model, 1, 4e-4, 1e-2);
  // At rest, before conduction tells more than a film of even heating has.
  const double rest = model.surface.air.initial_pressure;
  const double usual = alone.fit(0, 4e-4).exchange;
  EXPECT_NEAR(together.fit_together(rest, {4e-4, 4e-4}, {1.0, 2.0}).exchange, usual, 1e-9 * usual);
  const EnclosedAir shared = close_together(together, {1.0, 2.0}, 0.95, 0.95, 5e-5, 400, 0.0),
                    own = close(alone, 4e-4, 0.95, 5e-5, 400);
  EXPECT_NEAR(shared.pressure, own.pressure, 1e-9 * own.pressure);
  EXPECT_NEAR(together[1].hottest(), alone[0].hottest(), 1e-9 * 300.0);
}

TEST(GapColumns, ThatShareTheirAirSettleInTheirIntervals) {
  // By first order, as air flows at their ends; with the exchange of a film of even heating, in place of what
  // the interval before tells, 50 of them are wrong by as much as a film's heat is.
  SkinModel model = inert_model();
  model.base_conductivity = 0.0;
  const auto pressure = [&](int intervals) {
    GapColumns columns(model, 2, 4e-4, 1e-2, {.tolerance = 1e-7});
    return close_together(columns, {1.0, 2.0}, 0.99, 0.97, 2e-4, intervals, 0.0).pressure;
  };
  const double exact = pressure(1600);
  EXPECT_NEAR(pressure(50), exact, 0.01 * exact);
  EXPECT_NEAR(pressure(200), exact, 0.0025 * exact);
}

TEST(GapColumns, ReturnWhatStretchedAirTook) {
  // There and back, at once: as before.
  const SkinModel model = inert_model();
  GapColumns columns(model, 1, 1e-3, 1e-2);
  columns.fit(0, 2e-3);
  EXPECT_LT(columns[0].mean_air(), 240.0);
  const EnclosedAir air = columns.fit(0, 1e-3);
  EXPECT_NEAR(air.pressure, 101325.0, 1e-6);
  EXPECT_NEAR(columns[0].mean_air(), 300.0, 1e-9);
}

}  // namespace
