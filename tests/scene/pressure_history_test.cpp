// Smoothing of measured curves, and what it and their points leave open of the peak.
#include "launchsafe/scene/load.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace launchsafe::scene {
namespace {

Load measured(std::vector<double> time, std::vector<double> pressure, double smoothing) {
  Load load;
  load.duration = time.back();
  load.curve_time = std::move(time);
  load.curve_pressure = std::move(pressure);
  load.smoothing = smoothing;
  return load;
}

/// A pulse whose top is a parabola.
Load smooth_pulse() {
  Load load;
  load.shape = LoadShape::power_exponential;
  return load;
}

/// That pulse, measured at equal intervals over 18 ms.
Load pulse(std::size_t points, double smoothing) {
  const PressureHistory shape{smooth_pulse()};
  std::vector<double> time, pressure;
  for (std::size_t i = 0; i < points; ++i) {
    time.push_back(18e-3 * static_cast<double>(i) / static_cast<double>(points - 1));
    pressure.push_back(shape.at(time.back()));
  }
  return measured(time, pressure, smoothing);
}

double impulse(const Load& load) {
  const PressureHistory history(load);
  constexpr int steps = 40'000;
  const double dt = end_time(load) / steps;
  double sum = 0.5 * (history.at(0.0) + history.at(end_time(load)));
  for (int i = 1; i < steps; ++i) sum += history.at(i * dt);
  return sum * dt;
}

// The average of c t over [t - w/2, t + w/2] is c t; within w/2 of the start, where the mirror image begins,
// it is c (t^2 + w^2/4)/w.
TEST(Smoothing, AveragesAStraightLineAsByHand) {
  const PressureHistory history(measured({0.0, 10e-3}, {0.0, 100e6}, 2e-3));
  EXPECT_NEAR(history.at(5e-3), 50e6, 1.0);
  EXPECT_NEAR(history.at(3.3e-3), 33e6, 1.0);
  EXPECT_NEAR(history.at(0.0), 5e6, 1.0);
  EXPECT_NEAR(history.at(0.5e-3), 1e10 * (0.25e-6 + 1e-6) / 2e-3, 1.0);
  EXPECT_NEAR(history.at(10e-3), 95e6, 1.0);
  EXPECT_EQ(history.at(-1.0), history.at(0.0));
  EXPECT_EQ(history.at(1.0), history.at(10e-3));
}

TEST(Smoothing, KeepsTheImpulse) {
  for (const double window : {0.1e-3, 1e-3, 5e-3, 18e-3}) {
    EXPECT_NEAR(impulse(pulse(200, window)) / impulse(pulse(200, 0.0)), 1.0, 1e-6) << window;
    EXPECT_NEAR(impulse(pulse(7, window)) / impulse(pulse(7, 0.0)), 1.0, 1e-6) << window;
  }
}

// Near its top the pulse is a parabola, from which a window w takes |p''| w^2/24; p'' = -n p/t_m^2.
TEST(Smoothing, TakesFromThePeakWhatTheCurvatureSays) {
  const PressureHistory history(pulse(2000, 0.4e-3));
  const Load load = smooth_pulse();
  const double expected = load.exponent * 496e6 / std::pow(load.peak_time, 2) * 0.4e-3 * 0.4e-3 / 24.0;
  EXPECT_NEAR(496e6 - history.peak(), expected, 0.01 * expected);
  EXPECT_NEAR(history.stated_peak(), 496e6, 1e-6 * 496e6);
}

TEST(Smoothing, RescalesWhatIsSmooth) {
  Load load = pulse(50, 2e-3);
  load.rescale_to_peak = true;
  load.peak = 300e6;
  const PressureHistory history(load);
  EXPECT_NEAR(history.peak(), 300e6, 1.0);
  EXPECT_GT(history.stated_peak(), 301e6);
}

TEST(Smoothing, OfNoneChangesNothing) {
  const Load load = pulse(50, 0.0);
  const PressureHistory history(load);
  for (std::size_t i = 0; i < load.curve_time.size(); ++i)
    EXPECT_EQ(history.at(load.curve_time[i]), load.curve_pressure[i]);
}

TEST(StatedPeak, IsThatOfTheWholeLoadWhateverTheDuration) {
  Load analytic;
  analytic.duration = 5e-3;
  EXPECT_EQ(PressureHistory(analytic).stated_peak(), analytic.peak);
  EXPECT_LT(PressureHistory(analytic).peak(), 0.5 * analytic.peak);
  Load late = measured({0.0, 20e-3, 25e-3, 30e-3}, {0.0, 0.0, 400e6, 50e6}, 0.0);
  late.duration = 18e-3;
  EXPECT_EQ(PressureHistory(late).stated_peak(), 400e6);
  EXPECT_EQ(PressureHistory(late).peak(), 0.0);
  late.rescale_to_peak = true;
  late.peak = 500e6;
  EXPECT_EQ(PressureHistory(late).stated_peak(), 500e6);
}

const std::string curve_keys =
    "\ncurve_time = \"0, 0.5, 1 ms\"\ncurve_pressure = \"0, 100, 20 MPa\"\nsmoothing = ";

TEST(Smoothing, BelongsToAMeasuredCurveNoShorterThanItself) {
  const auto text = [](const std::string& keys) {
    return with(small_scene, "duration = \"1 ms\"", "duration = \"1 ms\"" + keys);
  };
  const auto file = parse_scene(text(curve_keys + "\"0.1 ms\""), "shell.toml");
  EXPECT_EQ(file.scene.load.smoothing, 1e-4);
  expect_error(error_of(text("\nsmoothing = \"0.1 ms\"")), 3, "load.smoothing");
  expect_error(error_of(text(curve_keys + "\"1.1 ms\"")), 5, "load.smoothing", "1.1 ms");
  // An average over next to nothing would be round-off, and could be 0.
  expect_error(error_of(text(curve_keys + "\"1e-300 s\"")), 5, "load.smoothing", "1e-300 s");
  EXPECT_FALSE(caught([&] { return parse_scene(text(curve_keys + "\"-1 ms\""), "shell.toml"); }));
  EXPECT_TRUE(caught([&] { return parse_scene(text("\nsmoothing = \"0 ms\""), "shell.toml"); }));
}

// Expected are the peak of the pulse, 496 MPa, and no more than what a fine curve can miss of it.
TEST(PeakBetweenPoints, IsNoHigherThanWhatIsSaidToBeMissed) {
  const PressureHistory shape{smooth_pulse()};
  for (const double interval : {2e-3, 1e-3, 0.5e-3, 0.2e-3, 20e-6}) {
    for (const double shift : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      Load load;
      for (double time = shift * interval; time < 18e-3; time += interval) {
        load.curve_time.push_back(time);
        load.curve_pressure.push_back(shape.at(time));
      }
      const double most = (1.0 + peak_missed_between_points(load)) * std::ranges::max(load.curve_pressure);
      EXPECT_GE(most, 496e6 * (1.0 - 1e-9)) << interval << " " << shift;
      EXPECT_LE(most, 496e6 * (1.0 + 0.12 * interval / 1e-3)) << interval << " " << shift;
      load.rescale_to_peak = true;
      EXPECT_EQ(peak_missed_between_points(load), 0.0) << "its peak is stated";
    }
  }
}

}  // namespace
}  // namespace launchsafe::scene
