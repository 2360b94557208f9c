// When a launch is over: analytic loads and measured curves, with and without a muzzle exit.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::scene {
namespace {

Load curve(std::vector<double> time, std::vector<double> pressure) {
  Load load;
  load.curve_time = std::move(time);
  load.curve_pressure = std::move(pressure);
  return load;
}

/// The shipped shell under the bell, with lines of [load] in place of its muzzle exit and expected velocity.
Expected<SceneFile> shell_with(const std::string& lines) {
  auto text = read_text_file(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
  text.insert(text.find("expected_velocity"), "# ");
  const std::string exit = "muzzle_exit = \"18 ms\"";
  text.replace(
      text.find(exit), exit.size(),
      "shape = \"bell\"\npeak_time = \"11.49 ms\"\nwidth = \"3.03 ms\"\nsteepness = 1.44\n" + lines + "\n");
  return caught([&] { return parse_scene(text, "shell.toml"); });
}

std::string fault_of(const std::string& lines) {
  const auto file = shell_with(lines);
  return file ? std::string{} : file.error().message();
}

void expect_fault(const std::string& lines, const std::vector<std::string>& parts) {
  const std::string fault = fault_of(lines);
  for (const std::string& part : parts)
    EXPECT_NE(fault.find(part), std::string::npos) << lines << ": " << fault;
}

// 11.49 ms + 3.03 ms (ln 100)^(1/1.44) = 20.24 ms, by hand.
TEST(LaunchEnd, ABellIsOverWhereAHundredthOfItsPeakIsLeft) {
  const Load load = published_bell();
  EXPECT_NEAR(launch_end(load), 20.24e-3, 0.01e-3);
  EXPECT_NEAR(share_left(load, end_time(load)), share_when_over, 1e-12);
  EXPECT_EQ(read_time(load), end_time(load));
}

// The definition itself, over exponents from cusps to spikes.
TEST(LaunchEnd, APowerExponentialIsOverWhereAHundredthOfItsPeakIsLeft) {
  for (const double exponent : {0.2, 1.0, 3.0, 13.578, 1000.0}) {
    Load load;
    load.exponent = exponent;
    EXPECT_GT(launch_end(load), load.peak_time);
    EXPECT_NEAR(share_left(load, launch_end(load)), share_when_over, 1e-10) << exponent;
  }
}

TEST(LaunchEnd, AMeasuredCurveIsOverAtItsLastPoint) {
  EXPECT_EQ(end_time(curve({0, 5e-3, 9e-3, 17e-3}, {0, 400e6, 100e6, 1e6})), 17e-3);
}

TEST(LaunchEnd, ADurationCutsALaunchShort) {
  Load load = published_bell();
  load.duration = 15e-3;
  EXPECT_EQ(end_time(load), 15e-3);
  EXPECT_TRUE(is_cut_short(load));
  load.duration = 21e-3;
  EXPECT_FALSE(is_cut_short(load));
  // A gauge that goes on after the pressure is gone.
  Load quiet = curve({0, 5e-3, 9e-3, 17e-3, 30e-3}, {0, 400e6, 100e6, 1e6, 0});
  quiet.duration = 18e-3;
  EXPECT_FALSE(is_cut_short(quiet));
  quiet.duration = 12e-3;
  EXPECT_TRUE(is_cut_short(quiet));
}

// exp(-(6.51/3.03)^1.44) = 0.0494 of the peak at 18 ms; 18 ms + 0.1 ms ln 4.94 = 18.16 ms.
TEST(LaunchEnd, BehindTheExitThePressureDecaysToTheBase) {
  Load load = published_bell();
  load.muzzle_exit = 18e-3;
  const PressureHistory barrel(published_bell()), history(load);
  EXPECT_EQ(history.at(17.9e-3), barrel.at(17.9e-3));
  EXPECT_NEAR(history.at(18.1e-3) - load.base, (barrel.at(18e-3) - load.base) / std::exp(1.0), 1.0);
  EXPECT_NEAR(end_time(load), 18.16e-3, 0.01e-3);
  EXPECT_NEAR(share_left(load, end_time(load)), share_when_over, 1e-12);
  EXPECT_EQ(read_time(load), 18e-3);
  load.exit_decay = 1e-3;
  EXPECT_NEAR(end_time(load), 19.60e-3, 0.02e-3);
}

TEST(LaunchEnd, BehindTheExitOfAMeasuredCurveThePressureDecaysToNothing) {
  Load load = curve({0, 5e-3, 9e-3, 17e-3}, {0, 400e6, 100e6, 60e6});
  load.muzzle_exit = 9e-3;
  const PressureHistory history(load);
  EXPECT_NEAR(history.at(9.1e-3), 100e6 / std::exp(1.0), 1.0);
  EXPECT_NEAR(end_time(load), 9e-3 + 0.1e-3 * std::log(25.0), 1e-9);
}

// 5.26 m until 18 ms: the double integral of p(t) A/m by another program (scene_test.cpp).
TEST(LaunchEnd, AnExitMayBeStatedAsATravel) {
  const auto file = shell_with("muzzle_travel = \"5.26 m\"");
  ASSERT_TRUE(file) << file.error().message();
  const Load& load = file->scene.load;
  EXPECT_NEAR(*load.muzzle_exit, 18e-3, 0.01e-3);
  // A load that pushes harder drives the shot out earlier.
  const SceneFile raised = with_keys(*file, {{"load.peak", 1.04 * load.peak, {}}});
  EXPECT_LT(*raised.scene.load.muzzle_exit, *load.muzzle_exit - 0.1e-3);
  // What is written back states the time, however it was stated; a time that is set takes the place of both.
  EXPECT_EQ(parse_scene(to_toml(file->scene), "again.toml").scene.load.muzzle_exit, load.muzzle_exit);
  EXPECT_EQ(with_keys(*file, {{"load.muzzle_exit", 17e-3, {}}}).scene.load.muzzle_exit, 17e-3);
  for (const char* travel : {"0.5 m", "9 m"})
    expect_fault(fmt::format("muzzle_travel = \"{}\"", travel), {"shell.toml:", "load.muzzle_travel"});
  expect_fault("muzzle_exit = \"18 ms\"\nmuzzle_travel = \"5.2 m\"", {"shell.toml:", "load.muzzle_travel"});
}

// 795.8 m/s follow from the bell; a pressure ten times or 6.895 times too large drives the shell that much
// faster.
TEST(LaunchEnd, AnExpectedVelocityIsACheckThatNamesBothNumbersAndTheUnit) {
  for (const char* velocity : {"800 m/s", "760 m/s", "0.83 km/s"})
    EXPECT_EQ(fault_of(fmt::format("muzzle_exit = \"18 ms\"\nexpected_velocity = \"{}\"", velocity)), "");
  expect_fault("muzzle_exit = \"18 ms\"\nexpected_velocity = \"850 m/s\"",
               {"shell.toml:", "load.expected_velocity", "850 m/s", "795.8 m/s", "5.26 m", "5 %"});
}

TEST(LaunchEnd, AnExpectedVelocityIsNoPartOfTheLaunchAndOfTheWholeOfIt) {
  const std::string exit = "muzzle_exit = \"18 ms\"", expected = "\nexpected_velocity = \"790 m/s\"";
  EXPECT_EQ(to_toml(shell_with(exit + expected)->scene), to_toml(shell_with(exit)->scene));
  EXPECT_EQ(fault_of(exit + "\nduration = \"12 ms\"" + expected), "");
}

TEST(LaunchEnd, AnExitThatIsNoneIsRefused) {
  expect_fault("muzzle_exit = \"21 ms\"", {"shell.toml:", "load.muzzle_exit", "20.2"});
  expect_fault("muzzle_exit = \"11 ms\"", {"load.muzzle_exit", "11.49 ms"});
}

}  // namespace
}  // namespace launchsafe::scene
