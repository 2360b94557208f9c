#include "launchsafe/trace/bottom_trace.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::trace;

BottomTrace example(std::size_t samples) {
  BottomTrace trace;
  trace.stations = {{"G1", 0.6775, 0.0625, 0.0, true}, {"S1", 0.6775, 0.001, 1e-4, false}};
  double time = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double value = static_cast<double>(k);
    time += k == 0 ? 0.0 : 1.0 + 0.1 * value;  // uneven intervals
    trace.time.push_back(time);
    trace.chamber_pressure.push_back(10.0 + value);
    trace.bottom_pressure.push_back(20.0 + value);
    trace.mean_bottom_pressure.push_back(9.5 + value * value);
    trace.friction.insert(trace.friction.end(), {value, 100.0 + value});
  }
  return trace;
}

double integral(const BottomTrace& trace) {
  double total = 0.0;
  for (std::size_t k = 1; k < trace.samples(); ++k) {
    total += (trace.time[k] - trace.time[k - 1]) * trace.mean_bottom_pressure[k];
  }
  return total;
}

TEST(Trace, OfRingsHasNoObservationPoints) {
  const BottomTrace whole = example(5), rings = of_rings(whole);
  ASSERT_EQ(rings.stations.size(), 1u);
  EXPECT_EQ(rings.stations[0].name, "S1");
  EXPECT_EQ(rings.bottom_pressure, whole.bottom_pressure);
  EXPECT_EQ(rings.friction, (std::vector{100.0, 101.0, 102.0, 103.0, 104.0}));
}

TEST(Trace, UntilATimeEndsWithTheLastSampleBefore) {
  const BottomTrace whole = example(9);
  const BottomTrace cut = until(whole, whole.time[5]),
                    between = until(whole, 0.5 * (whole.time[5] + whole.time[6]));
  for (const BottomTrace& each : {cut, between}) {
    EXPECT_EQ(each.samples(), 6u);
    EXPECT_EQ(each.time.back(), whole.time[5]);
    EXPECT_EQ(each.mean_bottom_pressure[3], whole.mean_bottom_pressure[3]);
    EXPECT_EQ(each.friction.size(), 12u);
  }
  EXPECT_EQ(until(whole, 2.0 * whole.time.back()).samples(), 9u);
}

TEST(Interpolate, IsLinearBetweenSamplesAndConstantOutside) {
  const std::vector<double> time{0.0, 1.0, 3.0}, value{1.0, 2.0, -2.0};
  EXPECT_EQ(interpolate(time, value, -1.0), 1.0);
  EXPECT_EQ(interpolate(time, value, 0.5), 1.5);
  EXPECT_EQ(interpolate(time, value, 1.0), 2.0);
  EXPECT_EQ(interpolate(time, value, 2.5), -1.0);
  EXPECT_EQ(interpolate(time, value, 9.0), -2.0);
}

TEST(Interpolate, WithoutAnAnswerGivesNotANumber) {
  EXPECT_TRUE(std::isnan(interpolate({}, {}, 0.0)));
  EXPECT_TRUE(std::isnan(interpolate({0.0, 1.0}, {1.0, 2.0}, std::nan(""))));
  EXPECT_TRUE(std::isnan(interpolate({0.0, 1.0}, {1.0}, 0.5)));
}

TEST(Trace, StretchedKeepsPressuresAndEnergiesAndTakesLonger) {
  const BottomTrace whole = example(9), longer = stretched(whole, 1.5);
  EXPECT_NEAR(integral(longer), 1.5 * integral(whole), 1e-12 * integral(whole));
  EXPECT_EQ(longer.friction, whole.friction);
  EXPECT_EQ(longer.bottom_pressure, whole.bottom_pressure);
}

/// a^2/b: 20 and 22 are 10 % apart, and so are 18.18 and 20.
TEST(Trace, MirroredIsAsFarOnTheOtherSide) {
  const BottomTrace whole = example(5);
  BottomTrace raised = whole;
  for (double& pressure : raised.bottom_pressure) pressure *= 1.1;
  const auto lowered = mirrored(whole, raised);
  ASSERT_TRUE(lowered);
  EXPECT_NEAR(lowered->bottom_pressure[3], whole.bottom_pressure[3] / 1.1, 1e-12);
  EXPECT_EQ(lowered->chamber_pressure, whole.chamber_pressure);
  EXPECT_EQ(lowered->friction, whole.friction) << "0 stays 0";
  EXPECT_FALSE(mirrored(whole, example(6)));
}

}  // namespace
