// One station of the skin equation: ignition, its cause and time, and failure.
#include "launchsafe/surface/skin.hpp"
#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

/// The point after `duration` in equal calls, with the ignition time counted from the begin.
SkinPoint after(const SkinModel& model, double gap, SkinPoint point, double duration, int calls, double air,
                double heating) {
  const double dt = duration / calls;
  double offset = 0.0;
  for (int call = 0; call < calls; ++call) {
    const bool was_ignited = point.ignited;
    point = advance_skin(model, gap, point, dt, air, air, heating);
    if (point.ignited && !was_ignited) offset = call * dt;
  }
  point.ignition_time += offset;
  return point;
}

SkinModel without_reaction() {
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  return model;
}

TEST(SkinIgnition, TriggerIsLocatedToANanosecondAtAnyCallLength) {
  // Only friction: 300 K + 3e4 K/s t reaches 525 K at 7.5 ms.
  for (const int calls : {1, 7, 1000, 100000}) {
    const SkinPoint point = after(without_reaction(), 0.0, {300.0}, 18e-3, calls, 300.0, 3e4);
    ASSERT_TRUE(point.ignited);
    EXPECT_NEAR(point.ignition_time, 7.5e-3, 1e-12) << calls;
    EXPECT_EQ(point.temperature, 784.0);  // no air: it stays where the reaction left it
    EXPECT_EQ(point.chemical_share, 0.0);
  }
}

TEST(SkinIgnition, FromThereOnlyTheExchangeActs) {
  SkinModel model = without_reaction();
  const double gap = 4e-4, rate = heat_capacity_ratio(model, gap) / model.surface.exchange_time;
  const SkinPoint point = after(model, gap, {784.0, true}, 10e-3, 10, 3000.0, 1e6);
  EXPECT_NEAR(point.temperature, 3000.0 - (3000.0 - 784.0) * std::exp(-rate * 10e-3), 1e-9);
}

TEST(SkinIgnition, RunawayBelowTheTriggerIsArrhenius) {
  SkinModel model = plain_model();
  model.kinetics.ignition_temperature = 700.0;
  const SkinPoint point = after(model, 0.0, {560.0}, 18e-3, 100, 300.0, 0.0);
  ASSERT_TRUE(point.ignited);
  EXPECT_EQ(point.chemical_share, 1.0);
  EXPECT_EQ(point.temperature, 784.0);
}

TEST(SkinIgnition, WithoutATriggerItIsSeenAtTheBurntTemperature) {
  SkinModel model = plain_model();
  model.kinetics.ignition_temperature = std::numeric_limits<double>::infinity();
  const SkinPoint point = after(model, 0.0, {560.0}, 18e-3, 100, 300.0, 0.0);
  ASSERT_TRUE(point.ignited);
  EXPECT_EQ(point.temperature, 784.0);
  // Zero-order induction time from 560 K, E/R = 21700 K: c T^2/(Q Z E/R) exp((E/R)/T) (1 + 2 T R/E + 6 (T
  // R/E)^2).
  const double e = 2.17e4, t = 560.0, small = t / e;
  const double induction =
      1780.0 * t * t / (5.82e6 * 2.01e18 * e) * std::exp(e / t) * (1.0 + 2.0 * small + 6.0 * small * small);
  EXPECT_NEAR(point.ignition_time / induction, 1.0, 1e-3);
}

TEST(SkinIgnition, WeakReactionHeatsInPartInsteadOfIgniting) {
  // Gain Q/(c (T2 - T1)) = 1/2: each kelvin past T1 from outside becomes two.
  SkinModel model = without_reaction();
  model.kinetics.heat_of_reaction = 0.5 * 1780.0 * (784.0 - 525.0);
  SkinPoint point = after(model, 0.0, {300.0}, 1e-2, 13, 300.0, 2.5e4);  // 250 K from outside: 25 past T1
  EXPECT_FALSE(point.ignited);
  EXPECT_NEAR(point.temperature, 525.0 + 50.0, 1e-8);
  point = after(model, 0.0, point, 1e-2, 13, 300.0, 2.5e4);
  ASSERT_TRUE(point.ignited);  // T2 after (784 - 575)/(2 25000 K/s)
  EXPECT_NEAR(point.ignition_time, 209.0 / 5e4, 1e-11);
}

TEST(SkinFailure, NextToAbsoluteZeroItIsStillATemperature) {
  // 1/T^2 is infinite there and the rate 0; their product must not stop the integration.
  const SkinModel model = plain_model();
  for (const double temperature : {4.9e-324, 1e-310, 1e-200, 1e-5}) {
    const double gap = 4e-4, rate = heat_capacity_ratio(model, gap) / model.surface.exchange_time;
    const SkinPoint point = advance_skin(model, gap, {temperature}, 1e-5, 300.0, 300.0, 0.0);
    EXPECT_NEAR(point.temperature / (-300.0 * std::expm1(-rate * 1e-5) + temperature), 1.0, 1e-7);
  }
}

TEST(SkinFailure, NotANumberStaysSoAndDoesNotIgnite) {
  const SkinModel model = plain_model();
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity}) {
    for (const SkinPoint& point : {advance_skin(model, 4e-4, {300.0}, 1e-5, bad, 500.0, 0.0),
                                   advance_skin(model, 4e-4, {300.0}, 1e-5, 500.0, bad, 0.0),
                                   advance_skin(model, 4e-4, {300.0}, 1e-5, 500.0, 500.0, bad),
                                   advance_skin(model, 4e-4, {bad}, 1e-5, 500.0, 500.0, 0.0)}) {
      EXPECT_TRUE(std::isnan(point.temperature));
      EXPECT_FALSE(point.ignited);
    }
  }
}

}  // namespace
