// Columns of a gap that closes: their account, and the limits of no conduction and of much.
#include "launchsafe/surface/gap_columns.hpp"

#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

SkinModel inert_model() {
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
  return model;
}

/// Closes a gap (m) by a part of itself in a time (s), as contact does: in every interval by an isentrope
/// with the exchange that the air states, in small steps; then the opening as it is.
EnclosedAir close(GapColumns& columns, double gap, double part, double time, int intervals) {
  constexpr int steps = 50;
  EnclosedAir air = columns.fit(0, gap);
  for (int i = 0; i < intervals; ++i) {
    const auto opening = [&](int step) {
      return gap * (1.0 - part * (i + double(step) / steps) / intervals);
    };
    double volume = air.volume, mean = 0.0, now = air.pressure;
    for (int step = 1; step <= steps; ++step) {
      const double before = now, middle = 0.5 * (opening(step - 1) + opening(step));
      const auto at = [&](double h) { return air.pressure * std::pow(volume / h, air.exponent); };
      const double left = std::exp(-time / intervals / steps * air.exchange / middle);
      volume *= left + (1.0 - left) * air.pressure * air.volume_at_walls / (at(middle) * middle);
      now = at(opening(step));
      mean += 0.5 * (before + now) / steps;
    }
    columns.advance(0, time / intervals, air.pressure, now, mean, 0.0);
    air = columns.fit(0, opening(steps));
  }
  return air;
}

TEST(GapColumns, AreOnTheAdiabatWhereTheyCloseAtOnce) {
  const SkinModel model = inert_model();
  GapColumns columns(model, 1, 1e-3, 1e-2);
  const EnclosedAir air = close(columns, 1e-3, 0.9, 1e-12, 100);
  EXPECT_NEAR(air.pressure / 101325.0, std::pow(10.0, 1.4), 1e-4 * std::pow(10.0, 1.4));
  EXPECT_NEAR(columns.mean_air(0), 300.0 * std::pow(10.0, 0.4), 0.1);
}

TEST(GapColumns, KeepTheTemperatureOfTheirWallsWhereTheyAreThin) {
  // p h is constant there, and the walls are not warmed by the little heat.
  const SkinModel model = inert_model();
  GapColumns columns(model, 1, 1e-5, 1e-2);
  const EnclosedAir air = close(columns, 1e-5, 0.5, 1e-2, 400);
  EXPECT_NEAR(air.pressure, 2.0 * 101325.0, 1e-3 * 101325.0);
  EXPECT_NEAR(columns.mean_air(0), 300.0, 0.1);
}

TEST(GapColumns, AccountForTheirHeatToRoundOff) {
  SkinModel model = inert_model();
  for (const double conductivity : {model.base_conductivity, 0.0}) {
    model.base_conductivity = conductivity;
    GapColumns columns(model, 1, 4e-4, 1e-2);
    close(columns, 4e-4, 0.97, 1e-4, 200);
    const FilmEnergy& energy = columns.energy(0);
    EXPECT_GT(energy.work, 10.0);
    EXPECT_LT(energy.residual(), 1e-9);
    if (!(conductivity > 0.0)) EXPECT_DOUBLE_EQ(energy.base, 0.0);
  }
}

TEST(GapColumns, AreOfSecondOrderInTheirIntervals) {
  const SkinModel model = inert_model();
  const auto hottest = [&](int intervals) {
    GapColumns columns(model, 1, 4e-4, 1e-2, {.tolerance = 1e-7});
    close(columns, 4e-4, 0.95, 5e-5, intervals);
    return columns.hottest(0);
  };
  const double exact = hottest(1600);
  EXPECT_GT(exact, 310.0);
  // By a factor of 2 in the length of intervals, on average over four of them.
  const double order = std::log2(std::abs(hottest(50) - exact) / std::abs(hottest(200) - exact)) / 2.0;
  EXPECT_GT(order, 1.6);
}

TEST(GapColumns, ReturnWhatStretchedAirTook) {
  // There and back, at once: as before.
  const SkinModel model = inert_model();
  GapColumns columns(model, 1, 1e-3, 1e-2);
  columns.fit(0, 2e-3);
  EXPECT_LT(columns.mean_air(0), 240.0);
  const EnclosedAir air = columns.fit(0, 1e-3);
  EXPECT_NEAR(air.pressure, 101325.0, 1e-6);
  EXPECT_NEAR(columns.mean_air(0), 300.0, 1e-9);
}

}  // namespace
