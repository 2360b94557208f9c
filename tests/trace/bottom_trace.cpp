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
    trace.mean_chamber_pressure.push_back(9.5 + value * value);
    trace.mean_bottom_pressure.push_back(19.5 + value);
    for (auto& closure : trace.friction) {
      closure.push_back(value);
      closure.push_back(100.0 + value);
    }
  }
  return trace;
}

double integral(const BottomTrace& trace) {
  double total = 0.0;
  for (std::size_t k = 1; k < trace.samples(); ++k) {
    total += (trace.time[k] - trace.time[k - 1]) * trace.mean_chamber_pressure[k];
  }
  return total;
}

TEST(ThinnedTrace, KeepsEverySecondSampleAndTheLast) {
  for (const std::size_t samples : {1, 2, 3, 8, 9}) {
    const BottomTrace whole = example(samples), half = thinned(whole);
    EXPECT_EQ(half.samples(), samples / 2 + 1);
    EXPECT_EQ(half.time.front(), whole.time.front());
    EXPECT_EQ(half.time.back(), whole.time.back());
    EXPECT_EQ(half.friction[0].size(), half.samples() * 2);
    EXPECT_EQ(half.friction[1].back(), whole.friction[1].back());
  }
}

TEST(ThinnedTrace, KeepsTheIntegralOfThePressure) {
  for (const std::size_t samples : {2, 5, 8, 40}) {
    const BottomTrace trace = example(samples);
    EXPECT_NEAR(integral(thinned(trace)), integral(trace), 1e-12 * integral(trace));
  }
}

TEST(Trace, OfRingsHasNoObservationPoints) {
  const BottomTrace whole = example(5), rings = of_rings(whole);
  ASSERT_EQ(rings.stations.size(), 1u);
  EXPECT_EQ(rings.stations[0].name, "S1");
  EXPECT_EQ(rings.bottom_pressure, whole.bottom_pressure);
  for (const auto& energy : rings.friction)
    EXPECT_EQ(energy, (std::vector{100.0, 101.0, 102.0, 103.0, 104.0}));
}

TEST(Trace, UntilATimeEndsWithTheLastSampleBefore) {
  const BottomTrace whole = example(9);
  const BottomTrace cut = until(whole, whole.time[5]),
                    between = until(whole, 0.5 * (whole.time[5] + whole.time[6]));
  for (const BottomTrace& each : {cut, between}) {
    EXPECT_EQ(each.samples(), 6u);
    EXPECT_EQ(each.time.back(), whole.time[5]);
    EXPECT_EQ(each.mean_chamber_pressure[3], whole.mean_chamber_pressure[3]);
    EXPECT_EQ(each.friction[1].size(), 12u);
  }
  EXPECT_EQ(until(whole, 2.0 * whole.time.back()).samples(), 9u);
}

TEST(ThinnedTrace, OfNothingIsNothing) { EXPECT_EQ(thinned(BottomTrace{}).samples(), 0u); }

TEST(ThinnedTrace, LeavesOutAClosureThatWasNotTraced) {
  BottomTrace trace = example(5);
  trace.friction[1].clear();
  EXPECT_TRUE(thinned(trace).friction[1].empty());
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
  EXPECT_EQ(longer.friction[0], whole.friction[0]);
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
  EXPECT_EQ(lowered->friction[0], whole.friction[0]) << "0 stays 0";
  EXPECT_FALSE(mirrored(whole, example(6)));
}

/// `example` with every pressure and energy times the square of a load.
BottomTrace under(double load, std::size_t samples = 5) {
  BottomTrace trace = example(samples);
  for (auto* values : {&trace.chamber_pressure, &trace.bottom_pressure, &trace.mean_chamber_pressure,
                       &trace.mean_bottom_pressure, &trace.friction[0], &trace.friction[1]})
    for (double& value : *values) value *= load * load;
  return trace;
}

/// Between 1 and 1.1 the line is at 1.084; it misses the 1 between 0.9^2 and 1.1^2 by 0.01. The square
/// of 1.04 is 1.0816.
TEST(TraceAtLoad, IsOnTheLineAndHigherByWhatThatMissesTheMiddleOfThreeBy) {
  const BottomTrace own = under(1.0), above = under(1.1), below = under(0.9), beyond = under(1.2);
  const auto found = at_load(1.04, {1.0, own}, {1.1, above}, {0.9, below});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->time, own.time);
  for (std::size_t k = 0; k < own.samples(); ++k) {
    EXPECT_NEAR(found->bottom_pressure[k], 1.096 * own.bottom_pressure[k], 1e-9);  // grows with time
    EXPECT_NEAR(found->friction[1][2 * k], 1.096 * own.friction[1][2 * k], 1e-9);
  }
  // The middle one of a case without a lower neighbour is the one above: 1.21 where the line has 1.22.
  const auto first = at_load(1.04, {1.0, own}, {1.1, above}, {1.2, beyond});
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->friction[0].back(), 1.096 * own.friction[0].back(), 1e-9);
}

/// What was missed at a time is not forgotten later: 2 less below make the line miss the middle by 1 less
/// 0.01 of its 1.
TEST(TraceAtLoad, KeepsTheLargestMissSoFar) {
  const BottomTrace own = under(1.0), above = under(1.1);
  BottomTrace below = under(0.9);
  below.friction[0][2] -= 2.0;  // G1 at the second sample
  const auto found = at_load(1.04, {1.0, own}, {1.1, above}, {0.9, below});
  ASSERT_TRUE(found);
  for (std::size_t k = 1; k < own.samples(); ++k)
    EXPECT_NEAR(found->friction[0][2 * k], 1.084 * own.friction[0][2 * k] + 1.2 * 0.99, 1e-9) << k;
  EXPECT_NEAR(found->friction[0][3], 1.096 * own.friction[0][3], 1e-9) << "of that station alone";
}

/// Friction that begins between two loads: whatever its onset, it counts whole.
TEST(TraceAtLoad, CoversALeapBetweenTheLoads) {
  BottomTrace own = under(1.0), above = under(1.0), below = under(1.0);
  for (double& energy : above.friction[0]) energy += 50.0;
  for (const double lower : {0.893, 0.95, 0.965})
    for (const double upper : {1.036, 1.06, 1.12}) {
      const auto found = at_load(1.04, {1.0, own}, {upper, above}, {lower, below});
      ASSERT_TRUE(found);
      EXPECT_GE(found->friction[0].back(), own.friction[0].back() + 50.0 - 1e-9) << lower << " " << upper;
      const auto first = at_load(1.04, {1.0, own}, {upper, above}, {upper * upper, above});
      ASSERT_TRUE(first);
      EXPECT_GE(first->friction[0].back(), own.friction[0].back() + 50.0 - 1e-9) << upper;
    }
}

/// Sampled at other times it is the same history.
TEST(TraceAtLoad, TakesLaunchesThatWereSampledAtOtherTimes) {
  const BottomTrace own = under(1.0, 9), above = under(1.1, 9), below = under(0.9, 9);
  BottomTrace finer = above;
  finer.time.insert(finer.time.begin() + 4, 0.5 * (above.time[3] + above.time[4]));
  for (auto* values : {&finer.chamber_pressure, &finer.bottom_pressure, &finer.mean_chamber_pressure,
                       &finer.mean_bottom_pressure})
    values->insert(values->begin() + 4, 0.5 * ((*values)[3] + (*values)[4]));
  for (auto& energy : finer.friction)
    for (const int station : {0, 1})
      energy.insert(energy.begin() + 8 + station, 0.5 * (energy[6 + station] + energy[8 + 2 * station]));
  const auto found = at_load(1.04, {1.0, own}, {1.1, finer}, {0.9, below}),
             expected = at_load(1.04, {1.0, own}, {1.1, above}, {0.9, below});
  ASSERT_TRUE(found && expected);
  for (std::size_t k = 0; k < own.samples(); ++k) {
    EXPECT_NEAR(found->mean_bottom_pressure[k], expected->mean_bottom_pressure[k], 1e-9) << k;
    for (const std::size_t station : {0, 1})
      EXPECT_NEAR(found->friction[0][2 * k + station], expected->friction[0][2 * k + station], 1e-9) << k;
  }
}

TEST(TraceAtLoad, OfALaunchThatEndsOtherwiseOrHasOtherStationsIsNothing) {
  const BottomTrace own = under(1.0), above = under(1.1);
  EXPECT_FALSE(at_load(1.04, {1.0, own}, {1.1, above}, {0.9, under(0.9, 7)}));
  EXPECT_FALSE(at_load(1.04, {1.0, own}, {1.1, above}, {0.9, of_rings(under(0.9))}));
  EXPECT_FALSE(at_load(1.04, {1.0, own}, {1.1, BottomTrace{}}, {0.9, under(0.9)}));
  EXPECT_FALSE(at_load(1.04, {1.0, BottomTrace{}}, {1.1, above}, {0.9, under(0.9)}));
}

TEST(Trace, DelayedHoldsTheStateOfTheInstant) {
  const BottomTrace whole = example(9);
  const double instant = whole.time[5], delay = 0.7;
  const BottomTrace later = delayed(whole, instant, delay);
  ASSERT_EQ(later.samples(), whole.samples() + 1);
  EXPECT_NEAR(later.time.back(), whole.time.back() + delay, 1e-12);
  EXPECT_NEAR(integral(later), integral(whole) + delay * whole.chamber_pressure[5], 1e-9);
  EXPECT_EQ(later.friction[1][2 * 6], whole.friction[1][2 * 5]);
}

TEST(Trace, ANegativeDelayLeavesOutWhatLiesBetween) {
  const BottomTrace whole = example(9);
  const BottomTrace sooner = delayed(whole, whole.time[6], whole.time[4] - whole.time[6]);
  ASSERT_EQ(sooner.samples(), whole.samples() - 2) << "the two before the instant";
  EXPECT_NEAR(sooner.time[4], whole.time[4], 1e-12);
  EXPECT_EQ(sooner.bottom_pressure[4], whole.bottom_pressure[6]);
  for (std::size_t k = 1; k < sooner.samples(); ++k) EXPECT_GT(sooner.time[k], sooner.time[k - 1]);
  EXPECT_EQ(delayed(whole, whole.time.back() + 1.0, 1.0).time, whole.time) << "nothing comes after it";
}

}  // namespace
