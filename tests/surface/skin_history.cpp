// The skin on a whole trace: air models, sampling, ignition, maxima, cost.
#include "launchsafe/surface/skin.hpp"
#include "launchsafe/surface/skin_equation.hpp"
#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

double last(const SkinHistory& history, const trace::BottomTrace& trace, std::size_t station) {
  return history.temperature[(history.time.size() - 1) * trace.stations.size() + station];
}

TEST(Ignites, SaysWhatTheWholeHistorySays) {
  const trace::BottomTrace trace = smooth_launch(200, 3, friction_energy);
  const SkinModel model = plain_model();
  int ignited = 0, safe = 0;
  for (int step = 0; step <= 20; ++step) {
    const double gap = 5e-5 * step;
    const auto found = IgnitionOfGaps(model, trace)(gap);
    ASSERT_TRUE(found) << gap;
    EXPECT_EQ(*found, integrate_skin(model, trace, gap).ignition.has_value()) << gap;
    ++(*found ? ignited : safe);
  }
  EXPECT_GT(ignited, 2);
  EXPECT_GT(safe, 2);
}

TEST(Ignites, SaysNothingWithoutATraceOrWithATemperatureThatIsNone) {
  const SkinModel plain = plain_model();
  const trace::BottomTrace empty;
  EXPECT_FALSE(IgnitionOfGaps(plain, empty)(1e-4));
  trace::BottomTrace trace = smooth_launch(50, 1, friction_energy);
  trace.mean_bottom_pressure[20] = std::nan("");
  EXPECT_FALSE(IgnitionOfGaps(plain, trace)(1e-4));
}

TEST(Ignites, KeepsAModelOfItsOwnAndNoTraceThatEnds) {
  const trace::BottomTrace trace = smooth_launch(50, 1, friction_energy);
  const IgnitionOfGaps ignites(plain_model(), trace);
  EXPECT_EQ(ignites(1e-4), IgnitionOfGaps(plain_model(), trace)(1e-4));
  EXPECT_FALSE((std::is_constructible_v<IgnitionOfGaps, SkinModel, trace::BottomTrace>));
  EXPECT_FALSE((std::is_constructible_v<detail::Intervals, SkinModel, trace::BottomTrace, double>));
}

// Each of more stations than a register holds has an interval in which it is heated most. The one that
// ignites is heated least over the whole launch: friction takes back there what it gave, which no launch
// does.
TEST(Ignites, LooksAtEveryStationThatMayBeTheHottest) {
  const SkinModel model = plain_model();
  for (const bool spike : {false, true}) {
    trace::BottomTrace trace = smooth_launch(50, 17, 0.5 * friction_energy);
    const std::size_t stations = trace.stations.size();
    for (std::size_t i = 0; i < trace.friction.size(); ++i) {
      const std::size_t sample = i / stations, station = i % stations;
      if (sample > station) trace.friction[i] += 0.01 * friction_energy;
      if (spike && station == 15 && sample == 25) trace.friction[i] += 3.0 * friction_energy;
    }
    EXPECT_EQ(IgnitionOfGaps(model, trace)(1e-4), spike);
    EXPECT_EQ(integrate_skin(model, trace, 1e-4).ignition.has_value(), spike);
  }
}

TEST(SkinHistory, WithoutGapOnlyFrictionHeats) {
  const trace::BottomTrace trace = smooth_launch(100, 0, friction_energy);
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  const SkinHistory history = integrate_skin(model, trace, 0.0);
  EXPECT_NEAR(last(history, trace, 0), 300.0 + 300.0 * friction_energy / (1717.0 * 1780.0), 1e-9);
  EXPECT_FALSE(history.ignition.has_value());
  EXPECT_EQ(history.air_temperature.front(), 300.0);
}

TEST(SkinHistory, EachTenthOfAMillimetreOfGapAddsLess) {
  // The shape of the paper's Table 8: 26.1, 25.5, 25.2 K.
  const trace::BottomTrace trace = smooth_launch(900, 0, friction_energy);
  double before = HUGE_VAL;
  for (const double gap : {0.0, 1e-4, 2e-4}) {
    const double added = last(integrate_skin(plain_model(), trace, gap + 1e-4), trace, 0) -
                         last(integrate_skin(plain_model(), trace, gap), trace, 0);
    EXPECT_GT(added, 0.0) << gap;
    EXPECT_LT(added, before) << gap;
    before = added;
  }
}

TEST(SkinHistory, SamplingErrorIsFourthOrder) {
  SkinModel model = plain_model();
  const auto temperature = [&](int intervals) {
    const trace::BottomTrace trace = smooth_launch(intervals, 0, 0.0);
    return last(integrate_skin(model, trace, 3e-4), trace, 0);
  };
  const double reference = temperature(3200);
  EXPECT_LE(std::abs(temperature(100) - reference), 1e-3);
  EXPECT_LE(std::abs(temperature(800) - reference), 1e-5);
}

TEST(SkinHistory, TracedTemperaturesAreThoseOfFineCalls) {
  // What a run with skin does: many small calls with the air at the ends of each. Second order in their
  // length.
  const trace::BottomTrace trace = smooth_launch(900, 0, 0.0), fine = smooth_launch(90000, 0, 0.0);
  const SkinModel model = plain_model();
  SkinPoint point{300.0};
  for (std::size_t k = 1; k < fine.samples(); ++k) {
    const auto air = [&](std::size_t sample) {
      return materials::adiabatic_temperature(model.surface.air, fine.bottom_pressure[sample]);
    };
    point = advance_skin(model, 3e-4, point, fine.time[k] - fine.time[k - 1], air(k - 1), air(k), 0.0);
  }
  EXPECT_NEAR(last(integrate_skin(model, trace, 3e-4), trace, 0), point.temperature, 1e-4);
}

TEST(SkinHistory, FirstIgnitionIsReportedWithTimeStationAndCause) {
  const trace::BottomTrace trace = smooth_launch(900, 3, 3.0 * friction_energy);
  SkinModel model;
  model.surface.localisation = 1048.1;
  const SkinHistory history = integrate_skin(model, trace, 0.0);
  ASSERT_TRUE(history.ignition.has_value());
  EXPECT_EQ(history.ignition->station, 2u);  // the station with the most friction; points do not count
  EXPECT_EQ(history.ignition->cause, IgnitionCause::trigger);
  EXPECT_LT(history.ignition->chemical_share, 0.5);
  EXPECT_GT(history.ignition->time, 0.01);
  EXPECT_LT(history.ignition->time, 0.018);
  EXPECT_NEAR(maximum_at_stations(history, trace).temperature, 784.0, 1e-9);
}

TEST(SkinHistory, NotANumberInTheTraceIsNoVerdict) {
  for (int which = 0; which < 3; ++which) {
    trace::BottomTrace trace = smooth_launch(300, 2, 3.0 * friction_energy);
    if (which == 0) trace.bottom_pressure[250] = std::nan("");
    if (which == 1) trace.mean_bottom_pressure[250] = std::nan("");
    if (which == 2) trace.friction[250 * 4 + 3] = std::nan("");
    const SkinHistory history = integrate_skin(plain_model(), trace, 3e-4);
    EXPECT_FALSE(history.ignition.has_value()) << which;
    EXPECT_TRUE(std::isnan(maximum_at_stations(history, trace).temperature)) << which;
  }
}

TEST(SkinHistory, ClosureThatWasNotTracedIsNoVerdict) {
  trace::BottomTrace trace = smooth_launch(10, 1, friction_energy);
  trace.friction.clear();
  EXPECT_TRUE(std::isnan(maximum_at_stations(integrate_skin(SkinModel{}, trace, 3e-4), trace).temperature));
}

// Found by the property test of random scenes: a mean pressure of 0 had a relative spread of 0/0.
TEST(SkinHistory, NoPressureAtAllLeavesAirAndSkinAsTheyWere) {
  trace::BottomTrace trace = smooth_launch(10, 1, 0.0);
  for (auto* pressures : {&trace.bottom_pressure, &trace.mean_bottom_pressure})
    std::fill(pressures->begin(), pressures->end(), 0.0);
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  for (const double gap : {0.0, 3e-4}) {
    const SkinHistory history = integrate_skin(model, trace, gap);
    for (const double temperature : history.temperature) EXPECT_NEAR(temperature, 300.0, 1e-9);
    for (const double temperature : history.air_temperature) EXPECT_NEAR(temperature, 300.0, 1e-9);
  }
}

TEST(SkinMaxima, AreTakenOverTheirStationsAndTimes) {
  trace::BottomTrace trace;
  trace.stations = {{"S1", 0, 0, 1, false}, {"G1", 0, 0, 0, true}, {"S2", 0, 0, 1, false}};
  SkinHistory history;
  history.time = {0.0, 1.0, 2.0};
  history.temperature = {300, 300, 300, 400, 900, 380, 350, 310, 420};
  const Maximum stations = maximum_at_stations(history, trace),
                points = maximum_at_observation_points(history, trace);
  EXPECT_EQ(stations.temperature, 420.0);
  EXPECT_EQ(stations.station, 2u);
  EXPECT_EQ(stations.time, 2.0);
  EXPECT_EQ(points.temperature, 900.0);
  EXPECT_EQ(points.station, 1u);
  EXPECT_EQ(maximum_at_time(history, trace, 1.5).temperature, 400.0);  // S2: (380 + 420)/2; S1: 375
  EXPECT_EQ(spread_at_time(history, trace, 1.5), 25.0);
  history.temperature[5] = std::nan("");
  EXPECT_TRUE(std::isnan(maximum_at_stations(history, trace).temperature));
  EXPECT_TRUE(std::isnan(maximum_at_time(history, trace, 1.0).temperature));
  EXPECT_TRUE(std::isnan(spread_at_time(history, trace, 1.0)));
}

}  // namespace
