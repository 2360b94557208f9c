#include "launchsafe/scene/load_shape.hpp"

#include "launchsafe/scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

/// Central difference of second order of (p - p0)^2, by the load itself.
double curvature(const Load& load, double time) {
  const PressureHistory history(load);
  const auto square = [&](double t) { return std::pow(history.at(t) - load.base, 2); };
  const double step = 1e-6;
  return (square(time + step) - 2.0 * square(time) + square(time - step)) / (step * step);
}

TEST(LoadShape, CurvatureOfSquaredPressureIsLargestAtTurningTimes) {
  for (const double exponent : {2.0, 8.0, 12.0, 30.0}) {
    Load load;
    load.exponent = exponent;
    load.duration = 1.0;
    const TurningTimes times = turning_times(load.peak_time, exponent);
    EXPECT_LT(times.fast, load.peak_time);
    EXPECT_GT(times.slow, load.peak_time);
    for (const double turn : {times.fast, times.slow}) {
      const double there = curvature(load, turn);
      for (const double aside : {0.9, 0.97, 1.03, 1.1}) EXPECT_GT(there, curvature(load, aside * turn));
    }
  }
}

TEST(LoadShape, ExponentMeetsTheDistance) {
  // Between 7.0 and 15.6 ms the paper's temperature without a gap rises fast.
  for (const double peak_time : {10e-3, 11e-3, 13e-3}) {
    const auto exponent = exponent_for(peak_time, 8.6e-3);
    ASSERT_TRUE(exponent);
    EXPECT_NEAR(turning_times(peak_time, *exponent).between(), 8.6e-3, 1e-12);
  }
}

TEST(LoadShape, NoExponentForDistancesOutOfReach) {
  EXPECT_FALSE(exponent_for(11e-3, 1.0));
  EXPECT_FALSE(exponent_for(11e-3, 1e-6));
  EXPECT_FALSE(exponent_for(11e-3, std::nan("")));
}

}  // namespace
}  // namespace launchsafe::scene
