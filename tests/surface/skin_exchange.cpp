// Exchange of heat between skin and air against exact exponentials, however stiff.
#include "launchsafe/surface/skin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;
using surface::SkinModel;

constexpr double exchange_gap = 4e-4, launch_time = 18e-3;  // m, s
constexpr double unit_round_off = 2.3e-16;

SkinModel inert_skin(double exchange_time) {
  SkinModel model;
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
  model.surface.friction = scene::FrictionClosure::none;
  model.surface.exchange_time = exchange_time;
  return model;
}

/// T(t) of T' = k (air + slope t - T) from `start`: air(t) - slope/k (1 - e^-kt) + (start - air) e^-kt.
double exact_exchange(double rate, double air, double slope, double start, double time) {
  const double x = rate * time;
  // slope (t - (1 - e^-x)/k), by its series where the two terms nearly cancel.
  const double followed = x < 1e-4 ? time * x * (0.5 - x / 6.0) : time + std::expm1(-x) / rate;
  return start - (air - start) * std::expm1(-x) + slope * followed;
}

class SkinExchange : public testing::TestWithParam<double> {};

TEST_P(SkinExchange, FollowsTheExactExponentialAtAnyCallLength) {
  const SkinModel model = inert_skin(GetParam());
  const double rate = surface::heat_capacity_ratio(model, exchange_gap) / model.surface.exchange_time;
  const double start = 300.0;
  const struct { double begin, slope; } airs[] = {{1500.0, 0.0}, {300.0, 2000.0 / launch_time}, {250.0, 0.0}};
  for (const auto& air : airs)
    for (const double step : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3, launch_time}) {
      SCOPED_TRACE(testing::Message() << "air from " << air.begin << " K, calls every " << step << " s");
      const bool heats = air.begin >= start;
      const int calls = static_cast<int>(std::min(std::ceil(launch_time / step), 20000.0));
      surface::SkinPoint point{start};
      for (int call = 1; call <= calls; ++call) {
        const double before = point.temperature, air_end = air.begin + air.slope * call * step;
        point = surface::advance_skin(model, exchange_gap, point, step,
                                      air.begin + air.slope * (call - 1) * step, air_end, 0.0);
        ASSERT_NEAR(point.temperature, exact_exchange(rate, air.begin, air.slope, start, call * step),
                    1e-10 * air_end + unit_round_off * start * call);
        // It neither passes the air nor turns back.
        ASSERT_LE(heats ? point.temperature - air_end : air_end - point.temperature,
                  4.0 * unit_round_off * air_end);
        ASSERT_TRUE(heats ? point.temperature >= before : point.temperature <= before);
        ASSERT_FALSE(point.ignited);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(ExchangeTimes, SkinExchange,
                         testing::Values(1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0));

TEST(SkinExchange, GoesWithTheHeatCapacityOfTheAir) {
  // 1.1766 0.01 1005/(1717 1e-4 1780) by hand.
  EXPECT_NEAR(surface::heat_capacity_ratio(inert_skin(3.6e-4), 0.01), 0.03869052, 5.01e-9);
}

TEST(SkinExchange, StaysFiniteAtDenormalArguments) {
  const SkinModel model;
  for (const double d : {4.9e-324, 1e-320, 1e-310, 2e-308}) {
    EXPECT_TRUE(
        std::isfinite(surface::advance_skin(model, d, {300.0}, 1e-6, 300.0, 1500.0, 0.0).temperature));
    EXPECT_TRUE(
        std::isfinite(surface::advance_skin(model, 3e-4, {300.0}, 1e-6, 300.0, 1500.0, d).temperature));
    EXPECT_TRUE(
        std::isfinite(surface::advance_skin(model, 3e-4, {300.0}, d, 1500.0, 1500.0, 1e4).temperature));
  }
}

}  // namespace
