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
  const auto file =
      scene::parse_scene("constants = \"none\"\n" + launchsafe::testing::small_shell +
                             launchsafe::testing::small_shell_base + interfaces +
                             "[load]\nduration = \"0.3 ms\"\npeak = \"200 MPa\"\npeak_time = \"0.2 ms\"\n"
                             "shape = \"power-exponential\"\n"
                             "[numerics]\ncell_size = \"2.5 mm\"\n",
                         "small.toml");
  EXPECT_TRUE(file) << file.error().message();
  return run_mechanics(file->scene);
}

std::string sliding(const std::string& body, const std::string& friction) {
  return "[interface." + body + "]\ncondition = \"sliding\"\nfriction = " + friction + "\n";
}

const InterfaceResult& of(const MechanicsResult& run, const std::string& body) {
  return *std::find_if(run.interfaces.begin(), run.interfaces.end(),
                       [&](const auto& each) { return each.body == body; });
}

TEST(InterfaceResults, AreNoneOfABondedCharge) {
  const MechanicsResult run = launch("");
  EXPECT_EQ(run.status, RunStatus::completed);
  EXPECT_TRUE(run.interfaces.empty());
  EXPECT_EQ(run.monitor.back().energy.contact, 0.0);
}

TEST(InterfaceResults, BookTheWorkOfFrictionByFaceAndArea) {
  const MechanicsResult run = launch(sliding("wall", "0.1") + sliding("base", "0.1") + sliding("cup", "0.1"));
  ASSERT_EQ(run.status, RunStatus::completed) << run.reason;
  ASSERT_EQ(run.interfaces.size(), 3u);
  double work = 0.0;
  for (const InterfaceResult& faces : run.interfaces) {
    work += faces.friction_work;
    EXPECT_LT(*std::max_element(faces.overlap.begin(), faces.overlap.end()), 1e-9) << faces.body;
    for (const double heat : faces.friction_heat) EXPECT_GT(heat, -1e-3) << faces.body;
  }
  // What contact takes out is friction, but for what faces lose when they close.
  const EnergyBalance& energy = run.monitor.back().energy;
  EXPECT_GT(work, 0.0);
  EXPECT_NEAR(energy.contact / work, 1.0, 0.02);
  EXPECT_LT(largest_energy_drift(run), 1e-6);
  // The wall's heat over the area of its face is its work: trapezia between the nodes of even cells.
  const InterfaceResult& wall = of(run, "wall");
  EXPECT_TRUE(wall.along_x);
  EXPECT_NEAR(wall.face, 0.015, 1e-12);
  double heat = 0.0;
  for (std::size_t k = 0; k + 1 < wall.place.size(); ++k)
    heat += 0.5 * (wall.friction_heat[k] + wall.friction_heat[k + 1]) * (wall.place[k + 1] - wall.place[k]);
  EXPECT_NEAR(2.0 * std::numbers::pi * 0.015 * heat / wall.friction_work, 1.0, 0.01);
  EXPECT_GT(*std::max_element(wall.slid.begin(), wall.slid.end()), 1e-6);
}

}  // namespace
}  // namespace launchsafe::run
