#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::run {
namespace {

/// Square cells of 2.5 mm along all bodies: particles fill their cells.
scene::Scene small_shell(scene::Formulation formulation = scene::Formulation::updated_lagrangian) {
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/stability/small_shell.toml").scene;
  scene.numerics.formulation = formulation;
  scene.numerics.cell_size = 2.5e-3;
  scene.load.duration = 0.4e-3;
  return scene;
}

/// The measured limit lies above that of Irons and Treharne for single particles, 2/sqrt(12), as it must, and
/// below that of particles that stay in the
/// middle of their cells, 1/sqrt(2), since the shell has free faces: the theory is sharp.
TEST(StableFactor, TheMeasuredLimitLiesBetweenTheTheoriesOfFreeAndFilledCells) {
  scene::Scene scene = small_shell();
  double stable = 0.5, broken = 1.0;
  std::uint64_t slowest = 0;
  for (int halving = 0; halving < 6; ++halving) {
    const double factor = 0.5 * (stable + broken);
    scene.numerics.time_step_factor = factor;
    const MechanicsResult run = run_mechanics(scene);
    (run.status == RunStatus::completed ? stable : broken) = factor;
    if (run.status == RunStatus::completed) continue;
    slowest = std::max(slowest, run.steps);
  }
  EXPECT_GE(stable, 2.0 / std::sqrt(12.0));
  EXPECT_LE(broken, 1.0 / std::sqrt(2.0));
  EXPECT_LT(slowest, 1500u) << "instability must be caught soon";
  RecordProperty("measured_limit", std::to_string(0.5 * (stable + broken)));
}

/// The measured limit lies above the proved one, and no more than a tenth.
TEST(StableFactor, OfTheLatticeIsSharp) {
  scene::Scene scene = small_shell(scene::Formulation::total_lagrangian);
  scene.numerics.time_step_factor = 0.68;
  EXPECT_EQ(run_mechanics(scene).status, RunStatus::completed);
  scene.numerics.time_step_factor = 0.76;
  const MechanicsResult broken = run_mechanics(scene);
  EXPECT_NE(broken.status, RunStatus::completed);
  EXPECT_LT(broken.steps, 1500u) << "instability must be caught soon";
}

/// Round-off without a load is no drift.
TEST(StableFactor, NothingMovesWithoutALoad) {
  scene::Scene scene = small_shell();
  scene.load.curve_time = {0.0, scene::end_time(scene.load)};
  scene.load.curve_pressure = {0.0, 0.0};
  const MechanicsResult run = run_mechanics(scene);
  EXPECT_EQ(run.status, RunStatus::completed) << run.reason;
  EXPECT_EQ(evaluate_gap(scene, run.trace, 2e-4).at_stations.temperature, scene.initial_temperature);
}

}  // namespace
}  // namespace launchsafe::run
