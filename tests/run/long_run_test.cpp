// Hundreds of thousands of steps: what drifts, and whether they repeat.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace launchsafe::run {
namespace {

constexpr int pulses = 10;

/// The small shell on a mesh of some three hundred particles, for so many steps: ten pulses one after the
/// other, without damping. Only the Maxwell elements take energy out, and that is booked. Two particles a
/// cell: with one a load cycle this slow and weak leaves more work unaccounted for than it stores, for a
/// reason that is not established yet; it shrinks with the cells.
scene::Scene pulsing_shell(double steps) {
  const std::string text =
      "numerics.cell_size = \"5 mm\"\nnumerics.particles_per_cell = 2\nload.base = \"0 Pa\"\n"
      "charge.crack_growth = false\nnumerics.energy_drift_limit = 100\n" +
      testing::small_shell + testing::small_shell_base + testing::small_shell_point;
  const auto file = scene::caught([&] { return scene::parse_scene(text, "long.toml"); });
  EXPECT_TRUE(file) << (file ? "" : file.error().message());
  scene::Scene scene = file->scene;
  scene.load.duration = steps * scene::make_plan(scene).time_step;
  scene.output.trace_interval = scene::end_time(scene.load) / 100.0;
  for (int i = 0; i <= 2 * pulses; ++i) {
    scene.load.curve_time.push_back(scene::end_time(scene.load) * i / (2 * pulses));
    scene.load.curve_pressure.push_back(i % 2 == 0 ? 0.0 : 20e6);
  }
  scene.numerics.selective_inertia = 1.0;
  return scene;
}

/// Axial momentum over the impulse of the load, the largest of the run.
double momentum_drift(const scene::Scene& scene, const MechanicsResult& result) {
  constexpr int intervals = 100000;
  const scene::PressureHistory load(scene.load);
  const double end = scene::end_time(scene.load);
  double impulse = 0.0;
  for (int i = 0; i < intervals; ++i) impulse += load.at(end * (i + 0.5) / intervals) * end / intervals;
  double largest = 0.0;
  for (const MonitorSample& sample : result.monitor) largest = std::max(largest, std::abs(sample.momentum));
  return largest / (impulse * scene::base_area(scene));
}

/// What the energy balance does not close by at most, over the largest energy that was stored.
double energy_gap(const MechanicsResult& result) {
  double gap = 0.0, stored = 0.0;
  for (const MonitorSample& sample : result.monitor) {
    gap = std::max(gap, std::abs(sample.energy.drift() * sample.energy.scale()));
    stored = std::max(stored, sample.energy.internal);
  }
  return gap / stored;
}

/// Largest energy stored in one of the pulses, J.
double stored_in(const scene::Scene& scene, const MechanicsResult& result, int pulse) {
  const double length = scene::end_time(scene.load) / pulses;
  double stored = 0.0;
  for (const MonitorSample& sample : result.monitor) {
    if (sample.time >= pulse * length && sample.time < (pulse + 1) * length)
      stored = std::max(stored, sample.energy.internal - sample.energy.viscous);
  }
  return stored;
}

bool same(const MechanicsResult& a, const MechanicsResult& b) {
  if (a.steps != b.steps || a.monitor.size() != b.monitor.size()) return false;
  for (std::size_t i = 0; i < a.monitor.size(); ++i) {
    const MonitorSample &x = a.monitor[i], &y = b.monitor[i];
    if (x.time != y.time || x.momentum != y.momentum || x.energy.kinetic != y.energy.kinetic ||
        x.energy.internal != y.energy.internal || x.energy.viscous != y.energy.viscous)
      return false;
  }
  return a.trace.time == b.trace.time && a.trace.bottom_pressure == b.trace.bottom_pressure &&
         a.trace.friction == b.trace.friction;
}

void expect_bounded_drift(double steps) {
  const scene::Scene scene = pulsing_shell(steps);
  const MechanicsResult result = run_mechanics(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.reason;
  const double gap = energy_gap(result), momentum = momentum_drift(scene, result);
  const double first = stored_in(scene, result, 1), last = stored_in(scene, result, pulses - 1);
  // Measured: 0.0054 in 1e4 steps, where pulses are short enough to ring a little, and 0.0038 in 1e6.
  EXPECT_LT(gap, 0.02);
  // Measured: 5e-9 and 6e-9; see the property test of random scenes for what is lost at light nodes.
  EXPECT_LT(momentum, 1e-7);
  EXPECT_NEAR(last, first, 0.01 * first);
  EXPECT_TRUE(same(result, run_mechanics(scene)));
}

TEST(LongRun, TenThousandStepsHoldEnergyAndMomentumAndRepeat) { expect_bounded_drift(1e4); }

TEST(LongRunSlow, AMillionStepsHoldEnergyAndMomentumAndRepeat) { expect_bounded_drift(1e6); }

}  // namespace
}  // namespace launchsafe::run
