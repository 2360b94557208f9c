#include "launchsafe/scene/scene.hpp"

#include "launchsafe/scene/read_scene.hpp"
#include "scene_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace launchsafe::scene {
namespace {

Scene shell_155mm() {
  const auto file = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
  return file.scene;
}

TEST(Scene, MassesOfTheShippedShellAreThoseOfTheModel) {
  const Scene scene = shell_155mm();
  EXPECT_NEAR(mass_of(scene, "steel"), 51.1314, 5e-5);
  EXPECT_NEAR(mass_of(scene, "charge"), 12.7625, 5e-5);
  EXPECT_NEAR(total_mass(scene), 63.8939, 5e-5);
  const double charge = 1717.0 * std::numbers::pi * 0.065 * 0.065 * 0.56;
  EXPECT_NEAR(mass_of(scene, "charge"), charge, 4e-15 * charge);
}

TEST(Scene, RigidAccelerationOfTheShippedShellIsThatOfTheModel) {
  const Scene scene = shell_155mm();
  EXPECT_NEAR(base_area(scene), std::numbers::pi * 0.0775 * 0.0775, 1e-17);
  EXPECT_NEAR(rigid_acceleration(scene, 496e6), 1.46479e5, 0.5);
  EXPECT_NEAR(1717.0 * 0.56 * rigid_acceleration(scene, 496e6), 140.843e6, 500.0);
}

TEST(PressureHistory, PowerExponentialRisesToItsPeakAndFalls) {
  Load load;
  load.shape = LoadShape::power_exponential;
  load.peak_time = 11e-3;
  load.exponent = 12.0;
  const PressureHistory history(load);
  EXPECT_EQ(history.at(0.0), load.base);
  EXPECT_EQ(history.at(-1.0), load.base);
  EXPECT_DOUBLE_EQ(history.at(load.peak_time), load.peak);
  EXPECT_DOUBLE_EQ(history.peak(), load.peak);
  const double ratio = 7.0 / 11.0;
  const double expected = load.base + (load.peak - load.base) * std::pow(ratio * std::exp(1.0 - ratio), 12.0);
  EXPECT_NEAR(history.at(7e-3), expected, 1e-12 * expected);
  for (double t = 0.0; t < 0.0179; t += 1e-4) {
    EXPECT_EQ(history.at(t) < history.at(t + 1e-4), t + 0.5e-4 < load.peak_time) << t;
  }
}

// Tabulated by another program, which rounds its parameters: at the flanks that is up to 3 %.
TEST(PressureHistory, BellHasTheTabulatedPressures) {
  const PressureHistory history(published_bell());
  const std::vector<std::pair<double, double>> table{
      {0.0, 0.6},    {2.0, 2.9},    {4.0, 12.5},   {6.0, 47.0},  {8.0, 146.0}, {10.0, 347.0},
      {11.0, 462.0}, {12.0, 459.0}, {14.0, 232.0}, {16.0, 84.0}, {18.0, 24.0}};
  for (const auto& [milliseconds, megapascals] : table)
    EXPECT_NEAR(1e-6 * history.at(1e-3 * milliseconds), megapascals, 0.05 + 0.025 * megapascals)
        << milliseconds;
  EXPECT_DOUBLE_EQ(history.peak(), 496e6);
  EXPECT_DOUBLE_EQ(history.peak_time(), 11.49e-3);
}

// 1/e of the rise is left at one width on either side, whatever the steepness.
TEST(PressureHistory, WidthOfABellIsWhereEulersNumberTimesLessIsLeft) {
  Load load = published_bell();
  for (const double steepness : {0.5, 1.44, 2.0, 6.0}) {
    load.steepness = steepness;
    const double left = load.base + (load.peak - load.base) / std::numbers::e;
    const PressureHistory history(load);
    EXPECT_NEAR(history.at(load.peak_time - load.width), left, 1e-9 * left);
    EXPECT_NEAR(history.at(load.peak_time + load.width), left, 1e-9 * left);
  }
}

// The same program gave 796 m/s and 5.26 m.
TEST(Scene, PublishedBellLaunchesTheShellLikeAGun) {
  Scene scene = shell_155mm();
  scene.load = published_bell();
  const RigidMotion end = rigid_motion(scene, 18e-3);
  EXPECT_NEAR(end.velocity, 796.0, 0.5);
  EXPECT_NEAR(end.travel, 5.26, 0.005);
}

// v = a t and s = a t^2/2.
TEST(Scene, RigidMotionUnderAConstantLoadIsThatOfFreeFall) {
  Scene scene = shell_155mm();
  scene.load.curve_time = {0.0, 2e-3};
  scene.load.curve_pressure = {100e6, 100e6};
  const double acceleration = rigid_acceleration(scene, 100e6);
  const RigidMotion motion = rigid_motion(scene, 2e-3);
  EXPECT_NEAR(motion.velocity, acceleration * 2e-3, 1e-9 * motion.velocity);
  EXPECT_NEAR(motion.travel, acceleration * 2e-6, 1e-9 * motion.travel);
}

/// By the midpoint rule with many parts.
RigidMotion finely_driven(const Load& load, double until) {
  constexpr int parts = 400'000;
  const PressureHistory history(load);
  const double dt = until / parts;
  RigidMotion motion;
  for (int part = 0; part < parts; ++part) {
    const double gained = dt * history.at((part + 0.5) * dt);
    motion.travel += dt * (motion.velocity + 0.5 * gained);
    motion.velocity += gained;
  }
  return motion;
}

void expect_driven_as_finely(const Load& load, double until) {
  const RigidMotion fine = finely_driven(load, until), motion = PressureHistory(load).drive(until);
  EXPECT_NEAR(motion.velocity, fine.velocity, 1e-7 * fine.velocity);
  EXPECT_NEAR(motion.travel, fine.travel, 1e-7 * fine.travel);
}

TEST(PressureHistory, DrivesAsFarAndFastAsItsIntegralsOfAnyShape) {
  Load load = published_bell();
  for (const double steepness : {1.1, 1.36939, 2.0, 6.0, 40.0}) {
    load.steepness = steepness;
    expect_driven_as_finely(load, 18e-3);
    expect_driven_as_finely(load, 10e-3);  // before the peak
  }
  load.muzzle_exit = 15e-3;
  expect_driven_as_finely(load, 18e-3);
  load = Load();
  load.shape = LoadShape::power_exponential;
  for (const double exponent : {1.0, 13.578, 50.0}) {
    load.exponent = exponent;
    expect_driven_as_finely(load, 18e-3);
  }
}

// A sine of which every period has six points.
TEST(PressureHistory, DrivesByEveryPointOfAMeasuredCurve) {
  Load load;
  for (int i = 0; i <= 9000; ++i) {
    load.curve_time.push_back(2e-6 * i);
    load.curve_pressure.push_back(300e6 + 100e6 * std::sin(i * std::numbers::pi / 3.0));
  }
  expect_driven_as_finely(load, 17.9e-3);
  load.smoothing = 5e-6;
  expect_driven_as_finely(load, 17.9e-3);
}

Load measured(std::vector<double> time, std::vector<double> pressure) {
  Load load;
  load.curve_time = std::move(time);
  load.curve_pressure = std::move(pressure);
  return load;
}

TEST(PressureHistory, MeasuredCurvePassesThroughItsPointsWithoutOvershoot) {
  const std::vector<double> time{0.0, 1e-3, 1.1e-3, 4e-3, 7e-3, 18e-3};
  const std::vector<double> pressure{1e5, 1e5, 4e8, 4.1e8, 2e8, 1e8};
  const PressureHistory history(measured(time, pressure));
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_DOUBLE_EQ(history.at(time[i]), pressure[i]);
  for (std::size_t i = 0; i + 1 < time.size(); ++i) {
    double last = pressure[i];
    const double direction = pressure[i + 1] >= pressure[i] ? 1.0 : -1.0;
    for (int k = 1; k <= 50; ++k) {
      const double value = history.at(time[i] + (time[i + 1] - time[i]) * k / 50.0);
      EXPECT_GE(direction * (value - last), -1e-6) << i << " " << k;
      last = value;
    }
  }
}

TEST(PressureHistory, MeasuredCurveIsHeldOutsideItsPoints) {
  for (const std::size_t points : {2u, 3u, 4u}) {
    const std::vector<double> time{1e-3, 2e-3, 3e-3, 5e-3}, pressure{1e5, 2e5, 4e5, 3e5};
    const auto end = static_cast<std::ptrdiff_t>(points);
    const PressureHistory history(
        measured({time.begin(), time.begin() + end}, {pressure.begin(), pressure.begin() + end}));
    EXPECT_EQ(history.at(0.0), 1e5);
    EXPECT_EQ(history.at(1.0), pressure[points - 1]);
    EXPECT_GT(history.at(1.5e-3), 1e5);
    EXPECT_LT(history.at(1.5e-3), 2e5);
    EXPECT_DOUBLE_EQ(history.at(2e-3), 2e5);
  }
}

TEST(PressureHistory, MeasuredCurveIsRescaledOnRequest) {
  Load load = measured({0.0, 1e-3, 2e-3, 3e-3}, {0.0, 1e8, 2e8, 1e8});
  load.peak = 5e8;
  EXPECT_DOUBLE_EQ(PressureHistory(load).at(2e-3), 2e8);
  load.rescale_to_peak = true;
  EXPECT_DOUBLE_EQ(PressureHistory(load).at(2e-3), 5e8);
  EXPECT_DOUBLE_EQ(PressureHistory(load).peak(), 5e8);
}

}  // namespace
}  // namespace launchsafe::scene
