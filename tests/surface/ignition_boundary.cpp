#include "launchsafe/surface/ignition_boundary.hpp"

#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

SkinModel with(SkinModel model, const SurfaceConstants& constants, double heat = 1.0) {
  model.surface.localisation = constants.localisation * heat;
  model.surface.exchange_time = constants.exchange_time / heat;
  model.kinetics.ignition_temperature = constants.ignition_temperature;
  return model;
}

Extent around(double middle, double half) { return {middle - half, middle + half}; }

bool does_ignite(const SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return integrate_skin(model, trace, gap).ignition.has_value();
}

/// ln(localisation * exchange time) of plain_model.
const double log_product = std::log(300.0 * 3.6e-4);

// By definition: with 1 % less heat than the margin says nothing ignites, with 1 % more it does. The
// constants lie between the places where the boundary was searched.
TEST(IgnitionBoundary, SeparatesWhatIgnitesFromWhatDoesNot) {
  const trace::BottomTrace trace = smooth_launch(240, 3, friction_energy);
  const SkinModel model = plain_model();
  for (const double gap : {0.0, 1e-4, 6e-4}) {
    const auto boundary = IgnitionBoundary::find(model, trace, gap, around(log_product, 3.0), {420.0, 640.0});
    ASSERT_TRUE(boundary) << gap;
    for (const SurfaceConstants& constants :
         {SurfaceConstants{300.0, 3.6e-4, 525.0}, SurfaceConstants{120.0, 2.1e-4, 471.0},
          SurfaceConstants{900.0, 1.3e-4, 619.0}, SurfaceConstants{700.0, 2e-3, 433.0}}) {
      const double heat = std::exp(boundary->log_heat_margin(constants));
      EXPECT_FALSE(does_ignite(with(model, constants, 0.98 * heat), trace, gap)) << gap << ' ' << heat;
      EXPECT_TRUE(does_ignite(with(model, constants, 1.02 * heat), trace, gap)) << gap << ' ' << heat;
    }
  }
}

// Friction alone, without reaction: T = T0 + localisation * energy/(density * specific heat).
TEST(IgnitionBoundary, WithoutGapIsWhereFrictionReachesTheTrigger) {
  const trace::BottomTrace trace = smooth_launch(240, 3, friction_energy);
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  const auto boundary = IgnitionBoundary::find(model, trace, 0.0, around(log_product, 1.0), {400.0, 700.0});
  ASSERT_TRUE(boundary);
  // Row 0 is the third of five stations: the hottest that tiles the bottom.
  const double rise =
      0.92 * friction_energy / (model.charge_density * model.specific_heat);  // K, localisation 1
  for (const double trigger : {400.0, 500.0, 700.0})
    EXPECT_NEAR(boundary->log_heat_margin({50.0, 1e-3, trigger}), std::log((trigger - 300.0) / (50.0 * rise)),
                2e-3);
}

TEST(IgnitionBoundary, IsFoundOverFactorsOfAHundredInBothConstants) {
  const trace::BottomTrace trace = smooth_launch(240, 3, friction_energy);
  EXPECT_TRUE(IgnitionBoundary::find(plain_model(), trace, 1.5e-3, around(log_product, 8.0), {340.0, 706.0}));
}

}  // namespace
