// The skin after the launch against closed forms of conduction and of induction, and against limits of an
// independent computation.
#include "launchsafe/surface/after_launch.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using namespace launchsafe;
using surface::follow_after_launch, surface::ignition_after_launch, surface::runaway_temperature,
    surface::SkinModel, surface::SkinResolution;

constexpr double charge = 302.0, hot_charge = 416.0;  // K; hot: by the friction of a launch
constexpr double hour = 3600.0;                       // s

/// Composition B on a charge of 1717 kg/m3, 1780 J/(kg K) and 0.246 W/(m K), under a skin of 0.1 mm, without
/// a trigger below 784 K. Q = 5.82 MJ/kg and Z = 2.01e18 1/s are of the paper, E/R = 21 700 K calibrated.
SkinModel composition_b() {
  SkinModel model;
  model.surface.skin_thickness = 1e-4;
  model.kinetics = {5.82e6, 2.01e18, 2.17e4, 784.0, 784.0};
  return model;
}

/// E/R as the paper prints it.
SkinModel printed() {
  SkinModel model = composition_b();
  model.kinetics.activation_temperature = 2.7e4;
  return model;
}

/// RDX: 47.1 kcal/mol, 2.02e18 1/s, 500 cal/g; Rogers, Thermochimica Acta 11, 131 (1975).
SkinModel rdx() {
  SkinModel model = composition_b();
  model.kinetics.heat_of_reaction = 2.09e6;
  model.kinetics.frequency = 2.02e18;
  model.kinetics.activation_temperature = 23702.0;
  return model;
}

SkinModel without_kinetics() {
  SkinModel model = composition_b();
  model.kinetics.frequency = 0.0;
  return model;
}

SkinModel triggered(SkinModel model, double ignition_temperature) {
  model.kinetics.ignition_temperature = ignition_temperature;
  return model;
}

/// s; NaN where it cools.
double ignition_time(const SkinModel& model, double skin, double below, SkinResolution resolution = {}) {
  return follow_after_launch(model, skin, below, hour, resolution).ignition_time.value_or(math::not_a_number);
}

/// T(0, t) of a slab 0 < x < h on a half-space under an insulated surface, which is the middle of a slab of
/// 2 h within a whole space: Carslaw & Jaeger, Conduction of Heat in Solids, 2.2.
double exact_surface(const SkinModel& model, double skin, double time) {
  const double diffusivity = model.conductivity / (model.charge_density * model.specific_heat);
  const double reach = 2.0 * std::sqrt(diffusivity * time);
  return charge + (skin - charge) * std::erf(model.surface.skin_thickness / reach);
}

double surface_error(double time, SkinResolution resolution) {
  return follow_after_launch(without_kinetics(), 500.0, charge, time, resolution).temperature -
         exact_surface(without_kinetics(), 500.0, time);
}

TEST(AfterLaunch, ConductsAsASlabOnAHalfSpace) {
  for (const double time : {1e-3, 5e-3, 10e-3, 20e-3, 40e-3, 60e-3, 90e-3, 120e-3}) {
    SCOPED_TRACE(testing::Message() << time << " s");
    EXPECT_NEAR(surface_error(time, {}), 0.0, 0.4);  // K, of 198
    EXPECT_NEAR(surface_error(time, {32, 1e-3}), 0.0, 0.015);
  }
}

TEST(AfterLaunch, StopsWhereItHasCooledByHalf) {
  const auto after = follow_after_launch(without_kinetics(), 500.0, charge);
  EXPECT_FALSE(after.ignition_time);
  EXPECT_LT(after.temperature, 401.0);
  EXPECT_NEAR(after.temperature, exact_surface(without_kinetics(), 500.0, after.time), 0.3);
}

TEST(AfterLaunch, IsOfSecondOrderInTheSpacing) {
  for (const double time : {5e-3, 120e-3}) {
    const double coarse = surface_error(time, {16, 1e-4}), fine = surface_error(time, {32, 1e-4});
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.25) << time << " s";
  }
}

TEST(AfterLaunch, IsOfThirdOrderInTime) {
  // The tolerance is on the error of the embedded second order, dt^3, so that errors fall as it does.
  for (const double time : {5e-3, 15e-3}) {
    const auto surface = [&](double tolerance) {
      return follow_after_launch(composition_b(), 500.0, charge, time, {6, tolerance}).temperature;
    };
    const double exact = surface(1e-7), coarse = surface(1e-2) - exact, fine = surface(1e-4) - exact;
    EXPECT_NEAR(std::log10(std::abs(coarse / fine)), 2.0, 0.3) << time << " s";
  }
}

/// s, of matter that keeps its heat.
double exact_induction(const SkinModel& model, double from, double to) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
  const auto slowness = [&](double temperature) {
    return 1.0 / materials::arrhenius_heating(model.kinetics, model.specific_heat, temperature);
  };
  return Quadrature::integrate(slowness, from, to, 15, 1e-10);
}

TEST(AfterLaunch, RunsAwayAfterItsInductionWithoutConduction) {
  for (const double ignition : {526.784, 784.0}) {
    SkinModel model = triggered(composition_b(), ignition);
    model.conductivity = 0.0;
    for (const double skin : {400.0, 450.0, 500.0, 520.0}) {
      SCOPED_TRACE(testing::Message() << "from " << skin << " K to " << ignition << " K");
      const double exact = exact_induction(model, skin, ignition);
      EXPECT_NEAR(ignition_time(model, skin, charge, {1, 1e-3}), exact, 1e-3 * exact);
      EXPECT_NEAR(ignition_time(model, skin, charge), exact, 0.03 * exact);
    }
  }
}

TEST(AfterLaunch, RunsAwayAsFrankKamenetskiiSays) {
  // His time is the first term of a series in e = T/(E/R): 1 + 2 e + 6 e^2 + ...
  SkinModel model = composition_b();
  model.conductivity = 0.0;
  const auto& k = model.kinetics;
  for (const double skin : {400.0, 450.0, 500.0, 520.0}) {
    const double e = skin / k.activation_temperature;
    const double first =
        model.specific_heat * skin * e * std::exp(1.0 / e) / (k.heat_of_reaction * k.frequency);
    EXPECT_NEAR(ignition_time(model, skin, charge, {1, 1e-3}) / first, 1.0 + 2.0 * e + 6.0 * e * e, 1e-3);
    EXPECT_NEAR(ignition_time(model, skin, skin, {6, 1e-3}) / first, 1.0 + 2.0 * e + 6.0 * e * e, 1e-3)
        << "on a charge as hot";
  }
}

// An explicit computation on even cells of 5 um gave these limits, to 0.1 or 1 K, and these times.
TEST(AfterLaunch, HasTheLimitsOfAnIndependentComputation) {
  for (const SkinResolution resolution : {SkinResolution{}, SkinResolution{16, 1e-2}}) {
    EXPECT_NEAR(runaway_temperature(composition_b(), charge, resolution), 500.5, 0.1);
    EXPECT_NEAR(runaway_temperature(composition_b(), hot_charge, resolution), 494.0, 1.0);
    EXPECT_NEAR(runaway_temperature(printed(), charge, resolution), 627.5, 0.2);
    EXPECT_NEAR(runaway_temperature(rdx(), charge, resolution), 562.3, 0.2);
  }
}

TEST(AfterLaunch, IgnitesWhenAnIndependentComputationDoes) {
  EXPECT_NEAR(ignition_time(composition_b(), 500.5, charge), 26.93e-3, 2.7e-3);
  EXPECT_NEAR(ignition_time(composition_b(), 501.0, charge), 18.86e-3, 0.03 * 18.86e-3);
  EXPECT_NEAR(ignition_time(composition_b(), 505.5, charge), 8.93e-3, 0.03 * 8.93e-3);
  const SkinModel model = triggered(composition_b(), 526.784);
  EXPECT_NEAR(ignition_time(model, 501.0, charge), 15.78e-3, 0.03 * 15.78e-3);
  EXPECT_NEAR(ignition_time(model, 505.5, charge), 7.02e-3, 0.03 * 7.02e-3);
}

TEST(AfterLaunch, ConvergesInBoth) {
  const SkinModel model = triggered(composition_b(), 526.784);
  const double finest = runaway_temperature(model, charge, {32, 1e-2});
  for (const double tolerance : {0.3, 0.1, 0.01}) {
    EXPECT_NEAR(runaway_temperature(model, charge, {6, tolerance}), finest, 0.1);
    EXPECT_NEAR(runaway_temperature(model, charge, {16, tolerance}), finest, 0.02);
  }
  const double exact = ignition_time(model, 505.5, charge, {32, 1e-3});
  EXPECT_NEAR(ignition_time(model, 505.5, charge), exact, 0.03 * exact);
  EXPECT_NEAR(ignition_time(model, 505.5, charge, {16, 1e-2}), exact, 0.005 * exact);
}

TEST(AfterLaunch, RunsAwayFromItsLimitOnAndNotBelow) {
  for (const double below : {250.0, charge, 350.0, 400.0, hot_charge}) {
    const double limit = runaway_temperature(composition_b(), below);
    EXPECT_TRUE(std::isfinite(ignition_time(composition_b(), limit, below))) << below << " K";
    EXPECT_TRUE(std::isnan(ignition_time(composition_b(), limit - 0.02, below))) << below << " K";
    EXPECT_LT(ignition_time(composition_b(), limit + 5.0, below),
              ignition_time(composition_b(), limit, below));
  }
}

TEST(AfterLaunch, IgnitesAtOnceAboveT1) {
  const SkinModel model = triggered(printed(), 526.784);
  EXPECT_EQ(ignition_time(model, 526.784, charge), 0.0);
  EXPECT_EQ(ignition_time(model, 600.0, charge), 0.0);
  EXPECT_NEAR(runaway_temperature(model, charge), 526.784, 0.01);
  EXPECT_EQ(runaway_temperature(model, 530.0), 526.784);
}

/// s; NaN where it cools. Of a launch that ended with these temperatures (K) of its station and of a hotter
/// observation point, which does not count.
double ignition_after(double station, double point, std::optional<surface::Ignition> ignition = {}) {
  trace::BottomTrace trace;
  trace.stations = {{"G1", 0.6775, 0.0625, 0.0, true}, {"S1", 0.6775, 0.06, 0.01, false}};
  surface::SkinHistory history;
  history.time = {0.0, 18e-3};
  history.temperature = {300.0, 300.0, point, station};
  history.ignition = ignition;
  return ignition_after_launch(composition_b(), history, trace, charge).value_or(math::not_a_number);
}

TEST(AfterLaunch, FollowsTheHottestStationFromTheEndOfALaunch) {
  const double limit = runaway_temperature(composition_b(), charge);
  EXPECT_EQ(ignition_after(limit + 0.1, 600.0), ignition_time(composition_b(), limit + 0.1, charge));
  EXPECT_TRUE(std::isfinite(ignition_after(limit + 0.1, 600.0)));
  EXPECT_TRUE(std::isnan(ignition_after(limit - 0.1, 600.0)));
  EXPECT_TRUE(std::isnan(ignition_after(450.0, 600.0)));
  EXPECT_TRUE(std::isnan(ignition_after(limit + 0.1, 600.0, surface::Ignition{17.7e-3, 1})));
}

TEST(AfterLaunch, TakesNoDoubtForCooling) {
  for (const double bad : {math::not_a_number, math::infinity})
    for (const auto number :
         {&materials::KineticsParameters::frequency, &materials::KineticsParameters::activation_temperature,
          &materials::KineticsParameters::heat_of_reaction}) {
      SkinModel model = composition_b();
      model.kinetics.*number = bad;
      const auto after = follow_after_launch(model, 510.0, charge);
      EXPECT_TRUE(std::isnan(after.time) && std::isnan(after.temperature));
      EXPECT_TRUE(after.ignition_time.has_value());
      EXPECT_TRUE(std::isnan(runaway_temperature(model, charge)));
    }
  EXPECT_TRUE(std::isnan(follow_after_launch(composition_b(), math::not_a_number, charge).time));
  EXPECT_TRUE(std::isnan(follow_after_launch(composition_b(), 510.0, math::not_a_number).time));
  EXPECT_TRUE(std::isnan(runaway_temperature(composition_b(), math::not_a_number)));
}

}  // namespace
