// Runs with two-way coupling: until ignition those of the launch, after it with gas that acts on all bodies.
#include "burning_scenes.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/run/run_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace launchsafe::run {
namespace {

using test_support::burning_gap;

constexpr double column_radius = 2.5e-3;  // m

scene::Scene column(double cell = 1.25e-3) {
  return test_support::burning_column(cell, column_radius, 0.6e-3);
}

double area() { return std::numbers::pi * column_radius * column_radius; }  // m2, of its bottom

TEST(TwoWayCoupling, IsTheTracedSkinWhereNothingIgnites) {
  scene::Scene scene = column();
  scene.charge().kinetics.ignition_temperature = 500.0;
  const CaseResult two_way = run_with_skin(scene, burning_gap);
  EXPECT_FALSE(two_way.gaps.front().combustion.has_value());
  const GapResult traced = evaluate_gap(scene, two_way.mechanics.trace, burning_gap);
  EXPECT_NEAR(two_way.gaps.front().at_stations.temperature, traced.at_stations.temperature, 1e-2);
}

// Shares by particle and the mass of the gas are counted apart.
TEST(TwoWayCoupling, SnapshotsTellWhatHasBurntOfEveryParticle) {
  scene::Scene scene = column();
  scene.output.snapshot_times = {0.0, 1e-3};
  const CaseResult result = run_with_skin(scene, burning_gap);
  ASSERT_EQ(result.mechanics.snapshots.size(), 2u);
  const Snapshot &rest = result.mechanics.snapshots[0], &burning = result.mechanics.snapshots[1];
  EXPECT_TRUE(rest.burnt_share.empty());
  ASSERT_EQ(burning.burnt_share.size(), burning.x.size());
  double mass = 0.0;
  for (std::size_t i = 0; i < rest.x.size(); ++i) {
    const double volume =
        2.0 * std::numbers::pi * rest.r[i] * 4.0 * rest.half_length_x[i] * rest.half_length_r[i];
    mass += burning.burnt_share[i] * rest.density[i] * volume;
    if (scene.bodies[static_cast<std::size_t>(burning.body[i])].material != "charge") {
      EXPECT_EQ(burning.burnt_share[i], 0.0);
    }
  }
  const CombustionHistory& c = *result.gaps.front().combustion;
  ASSERT_GT(mass, 0.0);
  EXPECT_NEAR(mass / trace::interpolate(c.time, c.burnt_mass, burning.time), 1.0, 0.01);
}

TEST(TwoWayCoupling, GoesThroughIgnitionWithItsEnergyBalanced) {
  scene::Scene scene = column();
  scene.combustion.duration = 1.5e-3;
  const CaseResult result = run_with_skin(scene, burning_gap);
  ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
  ASSERT_TRUE(result.gaps.front().skin.ignition.has_value());
  ASSERT_TRUE(result.gaps.front().combustion.has_value());
  const CombustionHistory& c = *result.gaps.front().combustion;
  const double ignition = result.gaps.front().skin.ignition->time;
  EXPECT_EQ(c.end, CombustionEnd::time);
  EXPECT_NEAR(result.mechanics.end_time, ignition + scene.combustion.duration, 1e-9);
  // The skin burns over the whole bottom, and nothing behind it.
  const double mass = c.burnt_mass.back();
  EXPECT_NEAR(mass / (1717.0 * area() * scene.surface.skin_thickness), 1.0, 1e-6);
  EXPECT_TRUE(std::is_sorted(c.burnt_mass.begin(), c.burnt_mass.end()));
  // Heat that it had and heat that it got bring it from 300 K to T2, and Eq. 40 heats it no further.
  EXPECT_NEAR((c.brought.back() + c.released.back()) / (mass * 1780.0 * (784.0 - 300.0)), 1.0, 1e-9);
  EXPECT_LT(c.energy_residual, 1e-9);
  EXPECT_LT(c.energy_drift, 0.01);
  // The gas takes more room than what it was made of, and so does the pressure on the bottom grow.
  EXPECT_GT(c.gas_volume.back(), 1.5 * mass / 1717.0);
  const double before = result.mechanics.trace.bottom_pressure.front();
  EXPECT_GT(*std::max_element(c.pressure.begin(), c.pressure.end()), before);
  EXPECT_GT(c.reaction_degree.back(), 0.999);
}

TEST(TwoWayCoupling, IsTheLaunchUntilIgnition) {
  const scene::Scene scene = column();
  const CaseResult coupled = run_with_skin(scene, burning_gap);
  const MechanicsResult launch = run_mechanics(scene);
  const double ignition = coupled.gaps.front().skin.ignition->time;
  ASSERT_GT(ignition, 1e-4);
  for (std::size_t i = 0; launch.trace.time[i] < ignition; ++i)
    ASSERT_EQ(coupled.mechanics.trace.bottom_pressure[i], launch.trace.bottom_pressure[i]) << i;
}

TEST(TwoWayCoupling, BreaksOffWhereTheGasLawEnds) {
  // Gas of 380 K at the density of the explosive: the virial series condenses there (Z < 0).
  scene::Scene scene = column();
  scene.charge().kinetics.burnt_temperature = 380.0;
  scene.charge().kinetics.activation_temperature = 1.2e4;
  const CaseResult result = run_with_skin(scene, burning_gap);
  EXPECT_EQ(result.mechanics.status, RunStatus::outside_gas_law) << to_string(result.mechanics.status);
  EXPECT_EQ(result.gaps.front().combustion->end, CombustionEnd::broke_off);
  EXPECT_FALSE(result.mechanics.reason.empty());
}

TEST(TwoWayCoupling, BurntMassDoesNotDependOnTheMesh) {
  // The skin is no part of the mesh: here it is from a twelfth to a third of a cell.
  for (const double cell : {1.25e-3, 0.625e-3, 0.3125e-3}) {
    scene::Scene scene = column(cell);
    const CaseResult result = run_with_skin(scene, burning_gap);
    ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
    const CombustionHistory& c = *result.gaps.front().combustion;
    EXPECT_LT(c.energy_drift, 0.01);
    EXPECT_NEAR(c.burnt_mass.back() / (1717.0 * area() * scene.surface.skin_thickness), 1.0, 1e-6);
  }
}

TEST(TwoWayCoupling, ACaseKeepsTheCombustionOfTheGapsThatIgnite) {
  scene::Scene scene = column();
  scene.surface.gaps = {0.0, burning_gap};
  const CaseResult result = run_case(scene);
  EXPECT_FALSE(result.gaps[0].combustion.has_value());
  ASSERT_TRUE(result.gaps[1].combustion.has_value());
  EXPECT_EQ(result.mechanics.end_time, scene::end_time(scene.load));
  scene.coupling = scene::Coupling::one_way;
  EXPECT_FALSE(run_case(scene).gaps[1].combustion.has_value());
}

}  // namespace
}  // namespace launchsafe::run
