// What a run tells of the faces that slid on the charge.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace launchsafe::run {
namespace {

MechanicsResult launch(const std::string& interfaces) {
  const auto file = scene::caught([&] {
    return scene::parse_scene(
        "constants = \"none\"\n" + launchsafe::testing::small_shell + launchsafe::testing::small_shell_base +
            interfaces +
            "[load]\nduration = \"0.3 ms\"\npeak = \"200 MPa\"\npeak_time = \"0.2 ms\"\n"
            "shape = \"power-exponential\"\n"
            "[numerics]\ncell_size = \"2.5 mm\"\n",
        "small.toml");
  });
  EXPECT_TRUE(file) << file.error().message();
  return run_mechanics(file->scene);
}

std::string sliding(const std::string& body, const std::string& friction) {
  return "[interface." + body + "]\ncondition = \"sliding\"\nfriction = " + friction + "\n";
}

TEST(InterfaceResults, AreNoneOfABondedCharge) {
  const MechanicsResult run = launch("");
  EXPECT_EQ(run.status, RunStatus::completed);
  EXPECT_TRUE(run.interfaces.empty());
  EXPECT_EQ(run.monitor.back().energy.contact, 0.0);
}

TEST(InterfaceResults, TellWhichFacesSlidAndThatTheyDidNotPassIntoEachOther) {
  const MechanicsResult run = launch(sliding("wall", "0.1") + sliding("base", "0.1") + sliding("cup", "0.1"));
  ASSERT_EQ(run.status, RunStatus::completed) << run.reason;
  ASSERT_EQ(run.interfaces.size(), 3u);
  for (const InterfaceResult& faces : run.interfaces) EXPECT_LT(faces.overlap, 1e-9) << faces.body;
  EXPECT_GT(run.monitor.back().energy.contact, 0.0) << "the work of friction";
  EXPECT_LT(largest_energy_drift(run), 1e-6);
}

}  // namespace
}  // namespace launchsafe::run
