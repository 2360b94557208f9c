#include "launchsafe/run/cost.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

TEST(OutOfReach, LetsOrdinaryRunsBegin) {
  EXPECT_FALSE(out_of_reach(small_file(), {}));
  const auto shipped = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value();
  EXPECT_FALSE(out_of_reach(shipped, {}));
  scene::Scene finest = shipped.scene;  // a day or so
  finest.numerics.cell_size = 0.25e-3;
  EXPECT_FALSE(out_of_reach(finest, {}));
}

struct Extreme {
  std::string key;  ///< that the refusal names
  std::function<void(scene::Scene&)> make;
};

TEST(OutOfReach, NamesTheKeyWhoseValueTakesTooLongOrTooMuch) {
  const std::vector<Extreme> extremes{
      {"numerics.time_step_factor", [](auto& s) { s.numerics.time_step_factor = 1e-300; }},
      {"numerics.time_step_factor", [](auto& s) { s.numerics.time_step_factor = 1e-12; }},
      {"numerics.cell_size", [](auto& s) { s.steel().strength.shear_modulus = 1e36; }},
      {"numerics.cell_size", [](auto& s) { s.steel().strength.shear_modulus = 1e308; }},
      {"numerics.cell_size", [](auto& s) { s.steel().eos.density = 1e-300; }},
      {"numerics.cell_size",
       [](auto& s) { s.steel().eos.density = std::numeric_limits<double>::denorm_min(); }},
      {"numerics.cell_size",
       [](auto& s) {
         s.load.duration = 1.0;
         s.numerics.cell_size = 1e-5;
       }},
      {"numerics.cell_size",
       [](auto& s) {
         for (auto& body : s.bodies) body.r_end *= 400.0;
         s.numerics.cell_size = 1e-5;
         s.numerics.particles_per_cell = 16;
       }},
      {"output.trace_interval",
       [](auto& s) {
         s.output.trace_interval = 1e-300;
         s.load.duration = 1.0;
       }},
      {"gap.thickness", [](auto& s) { s.surface.gaps.assign(1'000'000, 1e-4); }},
      {"output.snapshots", [](auto& s) { s.output.snapshot_times.assign(1'000'000, 1e-5); }}};
  for (const Extreme& extreme : extremes) {
    scene::SceneFile file = small_file();
    extreme.make(file.scene);
    const auto error = out_of_reach(file, {.memory = 1e8, .keeps_skins = true});
    ASSERT_TRUE(error) << extreme.key;
    EXPECT_EQ(error->key, extreme.key) << error->message();
    EXPECT_EQ(error->file, "shell.toml") << error->message();
  }
}

TEST(OutOfReach, GrowsWithWhatTheCallerAllows) {
  scene::SceneFile file = small_file();
  file.scene.numerics.time_step_factor = 1e-8;
  const double time = cost_of(file.scene).time();
  EXPECT_TRUE(out_of_reach(file, {.longest_run = 0.9 * time}));
  EXPECT_FALSE(out_of_reach(file, {.longest_run = 1.1 * time}));
}

TEST(OutOfReach, CountsWhatFollowsIgnition) {
  scene::SceneFile file = small_file();
  file.scene.coupling = scene::Coupling::two_way;
  EXPECT_FALSE(out_of_reach(file, {}));
  file.scene.combustion.duration = 1e6;
  const auto error = out_of_reach(file, {});
  ASSERT_TRUE(error);
  EXPECT_EQ(error->key, "combustion.duration") << error->message();
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
