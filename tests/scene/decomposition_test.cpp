// Decompositions whose numbers belong together, and the one that a flame lives on.
#include "launchsafe/scene/read_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace launchsafe::scene {
namespace {

/// ms, from 519 K and 550 K.
struct RunawayTimes {
  std::string name;
  double from_519, from_550;
};

// Computed by an independent script: composite Simpson rule with 2e5 intervals in ln(1 + 10 (T - T0)), to
// 2000 K, c = 1780 J/(kg K), from energies and heats in calories, 1 cal = 4.184 J and R = 1.987204 cal/(mol
// K). It gives five digits, and E/R in files has six.
const std::vector<RunawayTimes> independent{
    {"effective", 2.8603, 0.30529}, {"rdx", 341.44, 29.314}, {"comp-b-consistent", 223.59, 23.894}};

materials::KineticsParameters kinetics_named(const std::string& name) {
  Scene scene;
  scene.combustion.kinetics = name;
  return flame_kinetics(scene);
}

double runaway(const std::string& name, double from) {
  return 1e3 * materials::adiabatic_runaway_time(kinetics_named(name), Scene().charge().specific_heat, from);
}

TEST(Decomposition, RunsAwayInTheTimesOfAnIndependentQuadrature) {
  for (const RunawayTimes& each : independent) {
    EXPECT_NEAR(runaway(each.name, 519.0) / each.from_519, 1.0, 2e-4) << each.name;
    EXPECT_NEAR(runaway(each.name, 550.0) / each.from_550, 1.0, 2e-4) << each.name;
  }
  // Issue 30, point 10: the effective numbers heat some 100 times faster than either whose numbers belong
  // together.
  for (const Decomposition& each : shipped_decompositions())
    EXPECT_NEAR(runaway(each.name, 519.0) / runaway("effective", 519.0), 100.0, 25.0) << each.name;
}

// Model section 10: printed kinetics from 600 K, 7.425578e-2 s.
TEST(Decomposition, TheRunawayTimeIsThatOfTheClosedForm) {
  EXPECT_NEAR(
      materials::adiabatic_runaway_time(materials::named_kinetics("printed"), 1780.0, 600.0) / 7.425578e-2,
      1.0, 1e-7);
}

TEST(Decomposition, ThePageOfTheMaterialsHasThatTable) {
  std::ifstream file(LAUNCHSAFE_SOURCE_DIR "/studies/materials/README.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const RunawayTimes& each : independent) {
    const materials::KineticsParameters kinetics = kinetics_named(each.name);
    const std::string row =
        fmt::format("| `{}` | {:.6g} K | {:.3g} 1/s | {:.5g} MJ/kg | {:.3g} ms | {:.3g} ms |", each.name,
                    kinetics.activation_temperature, kinetics.frequency, 1e-6 * kinetics.heat_of_reaction,
                    runaway(each.name, 519.0), runaway(each.name, 550.0));
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(Decomposition, EveryShippedOneHasASourceForEveryNumber) {
  ASSERT_EQ(shipped_decompositions().size(), 2u);
  for (const Decomposition& each : shipped_decompositions())
    for (const auto& key : decomposition_keys())
      if (key.name != "title") {
        ASSERT_NE(source_of(each.sources, key.name), nullptr) << each.name << ' ' << key.name;
      }
  // Where that of Composition B was published was not found: no number of it may stand as literature.
  const Decomposition& unsourced = shipped_decompositions().front();
  EXPECT_EQ(unsourced.name, "comp-b-consistent");
  for (const Source& source : unsourced.sources) EXPECT_EQ(source.standing, Standing::assumed);
}

TEST(FlameKinetics, AreThoseOfRdxUnlessTheSceneSaysOtherwise) {
  const Scene scene;
  const materials::KineticsParameters flame = flame_kinetics(scene);
  EXPECT_EQ(flame.name, "rdx");
  EXPECT_EQ(flame.frequency, 2.02e18);
  EXPECT_NEAR(flame.activation_temperature, 47.1e3 / 1.987204, 0.05);
  EXPECT_NEAR(flame.heat_of_reaction, 500.0 * 4184.0, 1.0);
  // The mixture of the flame is that of the charge.
  EXPECT_EQ(flame.ignition_temperature, scene.charge().kinetics.ignition_temperature);
  EXPECT_EQ(flame.burnt_temperature, scene.charge().kinetics.burnt_temperature);
  const materials::KineticsParameters own = kinetics_named("effective");
  EXPECT_EQ(own.activation_temperature, scene.charge().kinetics.activation_temperature);
  EXPECT_EQ(own.heat_of_reaction, scene.charge().kinetics.heat_of_reaction);
}

// What the charge does not release cannot drive a flame.
TEST(FlameKinetics, HaveNoMoreHeatThanTheCharge) {
  Scene scene;
  scene.charge().kinetics.heat_of_reaction = 4e5;
  EXPECT_EQ(flame_kinetics(scene).heat_of_reaction, 4e5);
}

TEST(FlameKinetics, AreAKeyOfScenesWithTwoWayCouplingAlone) {
  const auto& key = *find_key(scene_keys(), "combustion.kinetics");
  EXPECT_EQ(key.words, (std::vector<std::string>{"comp-b-consistent", "rdx", "effective"}));
  Scene scene;
  EXPECT_FALSE(key.is_written(scene));
  scene.coupling = Coupling::two_way;
  EXPECT_TRUE(key.is_written(scene));
}

}  // namespace
}  // namespace launchsafe::scene
