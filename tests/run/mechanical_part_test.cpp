#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "scene/perturbed_scenes.hpp"
#include "store/same_case.hpp"

#include <gtest/gtest.h>

namespace launchsafe::run {
namespace {

/// Without the time that it took.
MechanicsResult launch_of(const scene::Scene& scene) {
  MechanicsResult result = run_mechanics(scene);
  result.wall_time = 0.0;
  return result;
}

TEST(MechanicalPart, RunsToTheSameBits) {
  for (const auto& [name, file] : scene::quick_scenes()) {
    SCOPED_TRACE(name);
    const MechanicsResult whole = launch_of(file.scene);
    EXPECT_EQ(whole.status, RunStatus::completed) << whole.reason;
    testing::expect_same(whole, launch_of(scene::mechanical_part(file.scene)));
  }
}

TEST(MechanicalPart, KeysThatItLeavesOutChangeNoBit) {
  for (const auto& [name, file] : scene::quick_scenes()) {
    const MechanicsResult launch = launch_of(file.scene);
    for (const auto& key : scene::scene_keys()) {
      if (!scene::is_dropped(file, key)) continue;
      SCOPED_TRACE(name + ", " + key.name);
      for (const scene::SceneFile& other : scene::perturbed(file, key))
        testing::expect_same(launch_of(other.scene), launch);
    }
  }
}

}  // namespace
}  // namespace launchsafe::run
