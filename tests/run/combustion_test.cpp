// Runs with two-way coupling: until ignition those of the launch, after it with gas that acts on all bodies.
#include "burning_scenes.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
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
  // And the skin that is stepped from the start.
  scene.coupling = scene::Coupling::one_way;
  const CaseResult one_way = run_with_skin(scene, burning_gap);
  EXPECT_NEAR(two_way.gaps.front().at_stations.temperature, one_way.gaps.front().at_stations.temperature,
              1e-2);
}

MechanicsResult launch_of(const scene::Scene& scene) {
  RunOptions options;
  options.checkpoints = true;
  return run_mechanics(scene, options);
}

CaseResult continued_run(scene::Scene scene, double gap_of_run, const MechanicsResult& launch) {
  scene.coupling = scene::Coupling::two_way;
  RunOptions options;
  options.launch = &launch;
  return run_with_skin(scene, gap_of_run, options);
}

TEST(Checkpoints, LeadToTheSameLaunchBitwise) {
  // The shipped shell, coarse, with faces that slide: particles, nodes, contact, trace and monitor go on.
  scene::Scene shell = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  shell.numerics.cell_size = 10e-3;
  shell.numerics.inertial_scaling = 16.0;
  for (const scene::Scene& scene : {column(), shell}) {
    const MechanicsResult from_start = launch_of(scene);
    ASSERT_EQ(from_start.status, RunStatus::completed);
    const CaseResult continued = continued_run(scene, 0.0, from_start);  // a gap of 0 does not ignite
    ASSERT_FALSE(continued.gaps.front().skin.ignition.has_value());
    EXPECT_EQ(continued.mechanics.steps, from_start.steps);
    EXPECT_EQ(continued.mechanics.trace.time, from_start.trace.time);
    EXPECT_EQ(continued.mechanics.trace.bottom_pressure, from_start.trace.bottom_pressure);
    EXPECT_EQ(continued.mechanics.trace.friction, from_start.trace.friction);
    ASSERT_EQ(continued.mechanics.monitor.size(), from_start.monitor.size());
    for (std::size_t i = 0; i < from_start.monitor.size(); ++i) {
      EXPECT_EQ(continued.mechanics.monitor[i].energy.internal, from_start.monitor[i].energy.internal);
      EXPECT_EQ(continued.mechanics.monitor[i].energy.contact, from_start.monitor[i].energy.contact);
      EXPECT_EQ(continued.mechanics.monitor[i].momentum, from_start.monitor[i].momentum);
    }
    EXPECT_EQ(continued.mechanics.interfaces.size(), from_start.interfaces.size());
    // Without checkpoints the mechanics is the same, and with them it is no other launch.
    EXPECT_EQ(run_mechanics(scene).trace.bottom_pressure, from_start.trace.bottom_pressure);
  }
}

TEST(Checkpoints, ALongerLaunchGoesOnFromItsBeginBitwise) {
  scene::Scene shell = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  shell.numerics.cell_size = 10e-3;
  shell.numerics.inertial_scaling = 16.0;
  const MechanicsResult launch = launch_of(shell);
  scene::Scene barrel = shell;
  barrel.load = scene::longer_launch(shell.load).value();
  const MechanicsResult whole = run_mechanics(barrel);
  RunOptions options;
  options.launch = &launch;
  options.same_until = scene::read_time(shell.load);
  const MechanicsResult continued = run_mechanics(barrel, options);
  EXPECT_GT(continued.steps_before, whole.steps / 2);
  EXPECT_EQ(continued.steps, whole.steps);
  EXPECT_EQ(continued.trace.time, whole.trace.time);
  EXPECT_EQ(continued.trace.bottom_pressure, whole.trace.bottom_pressure);
  EXPECT_EQ(continued.trace.friction, whole.trace.friction);
  EXPECT_EQ(continued.end_time, whole.end_time);
  ASSERT_EQ(continued.monitor.size(), whole.monitor.size());
  for (std::size_t i = 0; i < whole.monitor.size(); ++i) {
    EXPECT_EQ(continued.monitor[i].time, whole.monitor[i].time);
    EXPECT_EQ(continued.monitor[i].energy.external, whole.monitor[i].energy.external);
  }
  options.same_until = 0.0;
  EXPECT_EQ(run_mechanics(barrel, options).steps_before, 0u) << "nothing is said to be the same";
}

TEST(Checkpoints, SaveMostOfARunThatIgnitesLate) {
  scene::Scene scene = column();
  scene.charge().kinetics.ignition_temperature = 324.0;  // just before the end of the launch
  const MechanicsResult launch = launch_of(scene);
  scene.combustion.duration = 1e-5;
  const CaseResult continued = continued_run(scene, burning_gap, launch);
  ASSERT_TRUE(continued.gaps.front().skin.ignition.has_value());
  ASSERT_GT(continued.gaps.front().skin.ignition->time, 0.8 * scene::end_time(scene.load));
  // A run that is told to stop does so where it goes on: what it counts from the launch's begin is saved.
  scene.coupling = scene::Coupling::two_way;
  const std::atomic<bool> stop{true};
  RunOptions options;
  options.launch = &launch;
  options.stop = &stop;
  const CaseResult stopped = run_with_skin(scene, burning_gap, options);
  ASSERT_EQ(stopped.mechanics.status, RunStatus::interrupted);
  EXPECT_LT(continued.mechanics.steps - stopped.mechanics.steps, launch.steps / 2);
}

TEST(Checkpoints, AreMadeAgainWhereTheLaunchWasStored) {
  const scene::Scene scene = column();
  MechanicsResult launch = launch_of(scene);
  const CaseResult continued = continued_run(scene, burning_gap, launch);
  launch.checkpoints = nullptr;
  const CaseResult again = continued_run(scene, burning_gap, launch);
  const CombustionHistory &expected = *continued.gaps.front().combustion,
                          &found = *again.gaps.front().combustion;
  EXPECT_EQ(continued.gaps.front().skin.ignition->time, again.gaps.front().skin.ignition->time);
  EXPECT_EQ(continued.gaps.front().skin.temperature, again.gaps.front().skin.temperature);
  EXPECT_EQ(expected.burnt_mass, found.burnt_mass);
  EXPECT_EQ(expected.pressure, found.pressure);
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

TEST(TwoWayCoupling, BurnsTheSameWithAndWithoutSnapshots) {
  scene::Scene scene = column();
  scene.surface.friction = scene::FrictionClosure::total_strain_rate;
  const CaseResult without = run_with_skin(scene, burning_gap);
  scene.output.snapshot_times = {0.0, 1e-3};
  const CaseResult with = run_with_skin(scene, burning_gap);
  ASSERT_EQ(with.mechanics.snapshots.size(), 2u);
  EXPECT_GT(without.gaps.front().combustion->burnt_mass.back(), 0.0);
  EXPECT_EQ(without.gaps.front().combustion->burnt_mass, with.gaps.front().combustion->burnt_mass);
  EXPECT_EQ(without.gaps.front().combustion->pressure, with.gaps.front().combustion->pressure);
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
  // The whole bottom burns as deep as the flame has come, also beyond the skin.
  const double mass = c.burnt_mass.back();
  EXPECT_NEAR(mass / (1717.0 * area() * c.burnt_depth.back()), 1.0, 1e-6);
  EXPECT_GT(c.burnt_depth.back(), scene.surface.skin_thickness);
  EXPECT_GT(c.complete_time, ignition);
  EXPECT_TRUE(std::is_sorted(c.burnt_mass.begin(), c.burnt_mass.end()));
  // Heat that it had and heat that it got bring it from 300 K to T2; of its heat of reaction the rest is
  // kept.
  EXPECT_NEAR((c.brought.back() + c.released.back()) / (mass * 1780.0 * (784.0 - 300.0)), 1.0, 1e-9);
  EXPECT_NEAR((c.kept_back.back() + c.released.back()) / (mass * 5.82e6), 1.0, 1e-9);
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

// The flame's numbers are typed in here, and the conductive wave that they drive from 300 K is that of
// materials/burning.cpp; the ignition is the same to the last bit.
TEST(TwoWayCoupling, TheFlameLivesOnItsOwnDecompositionAndIgnitionDoesNot) {
  const materials::Charge charge;
  struct Expected {
    std::string name;
    double activation_temperature, frequency, heat;
  };
  const CaseResult published = run_with_skin(column(), burning_gap);
  for (const Expected& each :
       {Expected{"effective", 2.17e4, 2.01e18, 5.82e6}, Expected{"rdx", 23701.64, 2.02e18, 500.0 * 4184.0},
        Expected{"comp-b-consistent", 21688.76, 4.62e16, 758.0 * 4184.0}}) {
    scene::Scene scene = column();
    scene.combustion.kinetics = each.name;
    const CaseResult result = run_with_skin(scene, burning_gap);
    ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
    const CombustionHistory& c = *result.gaps.front().combustion;
    EXPECT_EQ(result.gaps.front().skin.ignition->time, published.gaps.front().skin.ignition->time);
    materials::KineticsParameters kinetics = scene.charge().kinetics;
    kinetics.activation_temperature = each.activation_temperature;
    kinetics.frequency = each.frequency;
    kinetics.heat_of_reaction = each.heat;
    const double speed = materials::deflagration_speed(kinetics, charge.conductivity,
                                                       charge.initial_density(), charge.specific_heat, 300.0);
    EXPECT_NEAR(c.bulk_flame_speed / speed, 1.0, 1e-6) << each.name;
    // What is released is the charge's heat of reaction, under each of them.
    EXPECT_NEAR((c.kept_back.back() + c.released.back()) / (c.burnt_mass.back() * 5.82e6), 1.0, 1e-9);
  }
}

TEST(TwoWayCoupling, FullReleaseKeepsNothingBackAndPressesHarder) {
  scene::Scene scene = column();
  const CaseResult published = run_with_skin(scene, burning_gap);
  scene.combustion.release = scene::HeatRelease::full;
  const CaseResult full = run_with_skin(scene, burning_gap);
  ASSERT_EQ(full.mechanics.status, RunStatus::completed) << full.mechanics.reason;
  const CombustionHistory& c = *full.gaps.front().combustion;
  EXPECT_NEAR(c.released.back() / (c.burnt_mass.back() * 5.82e6), 1.0, 1e-9);
  EXPECT_EQ(c.kept_back.back(), 0.0);
  EXPECT_LT(c.energy_residual, 1e-9);
  const CombustionHistory& cool = *published.gaps.front().combustion;
  EXPECT_GT(c.pressure[1], 1.2 * cool.pressure[1]);  // one sample after ignition
  EXPECT_GT(c.gas_volume.back(), 3.0 * cool.gas_volume.back());
  EXPECT_GT(c.gas_temperature.back(), 2000.0);
}

TEST(TwoWayCoupling, EndsAtTheStopPressure) {
  scene::Scene scene = column();
  scene.combustion.release = scene::HeatRelease::full;
  scene.combustion.stop_pressure = 35e6;
  const CaseResult result = run_with_skin(scene, burning_gap);
  const CombustionHistory& c = *result.gaps.front().combustion;
  EXPECT_EQ(result.mechanics.status, RunStatus::completed);
  EXPECT_EQ(c.end, CombustionEnd::pressure);
  EXPECT_GE(c.pressure.back(), 35e6);
  EXPECT_LT(result.mechanics.end_time,
            result.gaps.front().skin.ignition->time + scene.combustion.duration - 1e-5);
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
  // The flame is no part of the mesh: what burns by a time is that of its speed on any mesh. It passes from
  // cell to cell without a stop: here through the first cell of the finest one and into the second.
  std::vector<double> mass, pressure;
  for (const double cell : {1.25e-3, 0.625e-3, 0.3125e-3}) {
    scene::Scene scene = column(cell);
    scene.surface.skin_thickness = 4e-4;
    scene.surface.exchange_time = 1.25e-5;
    scene.charge().conductivity = 9.0 * scene.charge().conductivity;  // three times the speed
    scene.combustion.duration = 1.4e-3;
    const CaseResult result = run_with_skin(scene, burning_gap);
    ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
    const CombustionHistory& c = *result.gaps.front().combustion;
    mass.push_back(c.burnt_mass.back());
    pressure.push_back(c.pressure.back());
    EXPECT_LT(c.energy_drift, 0.01);
    EXPECT_NEAR(c.burnt_mass.back() / (1717.0 * area() * c.burnt_depth.back()), 1.0, 1e-6);
  }
  EXPECT_GT(mass.back(), 1717.0 * area() * 0.3125e-3);
  EXPECT_NEAR(mass[0] / mass[2], 1.0, 2e-3);
  EXPECT_NEAR(mass[1] / mass[2], 1.0, 2e-3);
  EXPECT_NEAR(pressure[1] / pressure[2], 1.0, 0.1);
}

TEST(TwoWayCoupling, InductionTimesAreThoseOfTheClosedForm) {
  // Adiabatic, zero order, printed kinetics, to 2000 K (model section 10). A gap of nothing exchanges
  // nothing.
  const std::pair<double, double> cases[] = {
      {600.0, 7.425578e-2}, {650.0, 2.746044e-3}, {700.0, 1.645534e-4}};
  for (const auto& [temperature, induction] : cases) {
    scene::Scene scene = column(5e-3);
    scene.initial_temperature = temperature;
    scene.surface.air.initial_temperature = temperature;
    scene.load.peak = 1e6;
    scene.load.duration = 1.2 * induction;
    scene.output.trace_interval = 0.01 * induction;
    scene.charge().kinetics = materials::named_kinetics("printed");
    scene.charge().kinetics.ignition_temperature = scene.charge().kinetics.burnt_temperature = 2000.0;
    scene.combustion.duration = 1e-6;
    const CaseResult result = run_with_skin(scene, 0.0);
    ASSERT_TRUE(result.gaps.front().skin.ignition.has_value()) << temperature;
    EXPECT_NEAR(result.gaps.front().skin.ignition->time / induction, 1.0, 1e-5) << temperature;
    EXPECT_EQ(result.gaps.front().skin.ignition->cause, surface::IgnitionCause::arrhenius);
    EXPECT_TRUE(result.gaps.front().combustion.has_value());
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
