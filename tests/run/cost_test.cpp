#include "launchsafe/run/cost.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace launchsafe::run {
namespace {

scene::SceneFile small_file() {
  const std::string text =
      "[load]\nduration = \"0.05 ms\"\n[numerics]\ncell_size = \"5 mm\"\nenergy_drift_limit = 0.5\n" +
      testing::small_shell + testing::small_shell_base + testing::small_shell_point;
  return scene::parse_scene(text, "shell.toml").value();
}

TEST(Cost, CountsOneSampleAStepAtMost) {
  scene::Scene scene = small_file().scene;
  scene.output.trace_interval = 1e-300;
  const Cost every_step = cost_of(scene);
  scene.output.trace_interval =
      scene::end_time(scene.load) / static_cast<double>(scene::make_plan(scene).steps);
  EXPECT_NEAR(every_step.trace, cost_of(scene).trace, 1e-6 * every_step.trace);
}

TEST(RunMechanics, SamplesEveryStepWhereTheIntervalIsShorter) {
  scene::Scene scene = small_file().scene;
  for (const double interval : {1e-12, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    scene.output.trace_interval = interval;
    const MechanicsResult result = run_mechanics(scene);
    EXPECT_EQ(result.status, RunStatus::completed) << result.reason;
    EXPECT_EQ(result.trace.samples(), result.steps + 1) << interval;
  }
}

TEST(RunMechanics, EndsWhereItsStepsWouldNotEndTheLaunch) {
  scene::Scene scene = small_file().scene;
  for (const double factor : {std::numeric_limits<double>::denorm_min(), 1e-300, 1e-18}) {
    scene.numerics.time_step_factor = factor;
    const MechanicsResult result = run_mechanics(scene);
    EXPECT_EQ(result.status, RunStatus::time_step_collapse) << result.reason;
    EXPECT_NE(result.reason.find("would not end"), std::string::npos) << result.reason;
  }
}

}  // namespace
}  // namespace launchsafe::run
