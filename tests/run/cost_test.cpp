#include "launchsafe/run/cost.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <string>

namespace launchsafe::run {
namespace {

scene::SceneFile small_file() {
  const std::string text =
      "[load]\nduration = \"0.05 ms\"\n[numerics]\ncell_size = \"5 mm\"\nenergy_drift_limit = 0.5\n" +
      testing::small_shell + testing::small_shell_base + testing::small_shell_point;
  return scene::parse_scene(text, "shell.toml");
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
  scene.output.trace_interval = 1e-300;
  const MechanicsResult result = run_mechanics(scene);
  EXPECT_EQ(result.status, RunStatus::completed) << result.reason;
  EXPECT_EQ(result.trace.samples(), result.steps + 1);
}

TEST(RunMechanics, EndsWhereItsStepsWouldNotEndTheLaunch) {
  scene::Scene scene = small_file().scene;
  for (const double factor : {1e-300, 1e-18}) {
    scene.numerics.time_step_factor = factor;
    EXPECT_EQ(run_mechanics(scene).status, RunStatus::time_step_collapse);
  }
}

}  // namespace
}  // namespace launchsafe::run
