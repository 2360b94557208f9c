#include "launchsafe/scene/plan.hpp"

#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace launchsafe::scene {
namespace {

Scene small() {
  const auto file = parse_scene(small_scene, "shell.toml");
  return file.scene;
}

bool is_in(const Scene& scene, std::string_view member) {
  const Plan plan = make_plan(scene);
  return std::ranges::find(plan.terms, member, &Term::member)->in;
}

TEST(Plan, LeavesConductionOutBelowItsBound) {
  Scene scene = small();
  scene.load.duration = 18e-3;
  EXPECT_NEAR(diffusion_length(scene.charge(), end_time(scene.load)), 38.06e-6, 0.01e-6);
  EXPECT_FALSE(is_in(scene, "conduction"));
  scene.physics.conduction = Switch::on;
  EXPECT_TRUE(is_in(scene, "conduction"));
  scene.physics.conduction = Switch::off;
  const Plan plan = make_plan(scene);
  EXPECT_FALSE(is_in(scene, "conduction"));
  EXPECT_FALSE(plan.conducts);
}

TEST(Plan, LeavesBulkReactionOutWhereTheChargeStaysCold) {
  Scene scene = small();
  EXPECT_GT(bulk_temperature_bound(scene), scene.initial_temperature);
  EXPECT_FALSE(is_in(scene, "bulk_reaction"));
  scene.physics.bulk_reaction = Switch::on;
  EXPECT_TRUE(is_in(scene, "bulk_reaction"));
  scene.physics.bulk_reaction = Switch::automatic;
  scene.initial_temperature = 480.0;
  EXPECT_TRUE(is_in(scene, "bulk_reaction"));
}

TEST(Plan, HasAirOnlyWhereThereIsAGap) {
  Scene scene = small();
  EXPECT_TRUE(is_in(scene, "air"));
  scene.surface.gaps = {0.0};
  EXPECT_FALSE(is_in(scene, "air"));
  EXPECT_TRUE(is_in(scene, "surface"));
}

TEST(Plan, CracksNeedFlawsAndARadius) {
  Scene scene = small();
  EXPECT_TRUE(is_in(scene, "cracks"));
  EXPECT_TRUE(is_in(scene, "crack_growth"));
  EXPECT_TRUE(is_in(scene, "crack_friction"));
  scene.charge().strength.face_friction = 0.0;
  EXPECT_FALSE(is_in(scene, "crack_friction"));
  scene.charge().strength.growth = false;
  EXPECT_FALSE(is_in(scene, "crack_growth"));
  EXPECT_TRUE(is_in(scene, "cracks"));
  scene.charge().strength.flaw_size = 0.0;
  EXPECT_FALSE(is_in(scene, "cracks"));
  scene = small();
  scene.charge().strength.initial_crack_radius = 0.0;
  EXPECT_FALSE(is_in(scene, "cracks"));
}

TEST(Plan, SteelAloneHasNoSurface) {
  Scene scene = small();
  scene.bodies = {{"bar", "steel", 0.0, 0.1, 0.0, 0.01}};
  const Plan plan = make_plan(scene);
  EXPECT_FALSE(is_in(scene, "surface"));
  EXPECT_FALSE(is_in(scene, "air"));
  EXPECT_FALSE(is_in(scene, "cracks"));
  EXPECT_FALSE(is_in(scene, "bulk_reaction"));
  ASSERT_EQ(plan.by_material.size(), 1U);
  EXPECT_EQ(plan.by_material[0].material, "steel");
}

TEST(Plan, TellsWhatARunThroughIgnitionAddsAndAtWhichCost) {
  Scene scene = small();
  EXPECT_FALSE(is_in(scene, "coupling"));
  EXPECT_EQ(make_plan(scene).coupled_work, 0.0);
  scene.coupling = Coupling::two_way;
  scene.combustion.duration = 1e-3;
  const Plan plan = make_plan(scene);
  EXPECT_TRUE(is_in(scene, "coupling"));
  // A millisecond more of burning costs more than a millisecond of the launch.
  scene.combustion.duration = 2e-3;
  EXPECT_GT(make_plan(scene).coupled_work - plan.coupled_work, plan.work * 1e-3 / end_time(scene.load));
  EXPECT_EQ(make_plan(scene).work, plan.work);
  // The launch is computed once more.
  EXPECT_GT(plan.coupled_work, plan.work);
}

TEST(Plan, CountsParticlesAndStepsAsTheMeshDoes) {
  Scene scene = small();
  scene.numerics.selective_inertia = 1.0;
  EXPECT_NEAR(longitudinal_speed(scene), 5905.50, 0.01);
  const Plan plan = make_plan(scene);
  EXPECT_EQ(plan.particles(), particle_count(scene));
  EXPECT_NEAR(plan.time_step, 0.5 * 2.5e-3 / 5905.50, 1e-12);
  EXPECT_EQ(plan.steps, static_cast<std::int64_t>(std::ceil(1e-3 / plan.time_step)));
  scene.numerics.selective_inertia = 3.0;
  EXPECT_NEAR(make_plan(scene).time_step, 3.0 * plan.time_step, 1e-15);
  scene.numerics.selective_inertia = 1.0;
  scene.numerics.inertial_scaling = 16.0;
  EXPECT_NEAR(make_plan(scene).time_step, 4.0 * plan.time_step, 1e-15);
}

TEST(Plan, StepsThatCannotBeCountedAreNotTakenForFew) {
  for (const double factor : {1e-300, std::numeric_limits<double>::denorm_min()}) {
    Scene scene = small();
    scene.numerics.time_step_factor = factor;
    const Plan plan = make_plan(scene);
    EXPECT_EQ(plan.steps, most_counted);
    EXPECT_GT(plan.work, 1e100);
  }
}

// A straight line's change within a window is its slope times the window.
TEST(LargestChanges, OfStraightLinesAreTheirSlopesTimesTheWindow) {
  Load load;
  load.curve_time = {0.0, 10e-3, 30e-3};
  load.curve_pressure = {0.0, 100e6, 0.0};
  const LargestChanges changes = largest_changes(load, 1e-3);
  EXPECT_NEAR(changes.rise, 10e6, 1e-3);
  EXPECT_NEAR(changes.fall, 5e6, 1e-3);
}

}  // namespace
}  // namespace launchsafe::scene
