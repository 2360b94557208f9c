#include "launchsafe/run/run_case.hpp"

#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <thread>

namespace launchsafe::run {
namespace {

/// The shipped scene with a bonded base and a smooth wall, at a mesh that runs in a fraction of a second.
scene::Scene coarse_scene() {
  const auto shipped =
      scene::caught([&] { return scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml"); });
  const auto bonded_base = scene::find_constants("bonded_base", {}, {}, "constants");
  scene::Scene scene = scene::with_constants(*shipped, bonded_base).scene;
  scene.numerics.cell_size = 10e-3;
  scene.numerics.inertial_scaling = 16.0;
  scene.numerics.selective_inertia = 1.0;
  scene.load.duration = 18e-3;  // until the exit
  return scene;
}

bool same(const trace::BottomTrace& a, const trace::BottomTrace& b) {
  return a.time == b.time && a.bottom_pressure == b.bottom_pressure &&
         a.mean_bottom_pressure == b.mean_bottom_pressure && a.friction == b.friction;
}

TEST(RunMechanics, CompletesTheLaunchWithAClosedEnergyBalance) {
  const MechanicsResult result = run_mechanics(coarse_scene());
  ASSERT_EQ(result.status, RunStatus::completed) << result.reason;
  EXPECT_NEAR(result.end_time, 18e-3, 1e-12);
  EXPECT_NEAR(result.trace.time.back(), 18e-3, 1e-12);
  // Masses: model section 1, six digits.
  EXPECT_NEAR(mass_of(result, "steel"), 51.1314, 5e-5);
  EXPECT_NEAR(mass_of(result, "charge"), 12.7625, 5e-5);
  for (const MonitorSample& sample : result.monitor) {
    if (sample.energy.scale() < 1.0) continue;  // J, of about 1000 at the peak
    EXPECT_LT(std::abs(sample.energy.drift()), 2e-3) << "at " << sample.time;
    EXPECT_GE(sample.energy.plastic, 0.0);
    EXPECT_GE(sample.energy.viscous, 0.0);
    EXPECT_GE(sample.energy.crack, 0.0);
  }
  EXPECT_GT(result.update_rate(), 0.0);
}

TEST(RunMechanics, FrictionEnergyNeverFallsAndTheBottomPressureFollowsTheLoad) {
  scene::Scene scene = coarse_scene();
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.peak_time = 12.9641e-3;
  const trace::BottomTrace trace = run_mechanics(scene).trace;
  const std::size_t stations = trace.stations.size();
  for (std::size_t i = stations; i < trace.friction.size(); ++i)
    EXPECT_GE(trace.friction[i], trace.friction[i - stations]);
  // A wall without friction carries nothing of the charge's weight: the bottom sees the setback pressure of
  // the charge, 140.843 MPa (model section 1), but for what base and walls store of the load.
  const double peak = *std::max_element(trace.bottom_pressure.begin(), trace.bottom_pressure.end());
  EXPECT_NEAR(peak, 140.843e6, 0.01 * 140.843e6);
}

TEST(RunMechanics, IsBitwiseTheSameOnEveryThread) {
  scene::Scene scene = coarse_scene();
  scene.load.duration = 9e-3;
  const MechanicsResult here = run_mechanics(scene);
  MechanicsResult there[2];
  std::thread first([&] { there[0] = run_mechanics(scene); }),
      second([&] { there[1] = run_mechanics(scene); });
  first.join();
  second.join();
  EXPECT_TRUE(same(here.trace, there[0].trace));
  EXPECT_TRUE(same(here.trace, there[1].trace));
}

TEST(RunMechanics, SaysWhenAndWhereAnUnstableStepBreaksTheRun) {
  scene::Scene scene = coarse_scene();
  scene.numerics.time_step_factor = 3.0;  // beyond any explicit limit
  const MechanicsResult result = run_mechanics(scene);
  EXPECT_NE(result.status, RunStatus::completed);
  EXPECT_NE(result.reason.find("t = "), std::string::npos) << result.reason;
  EXPECT_LT(result.end_time, 18e-3);
}

TEST(RunMechanics, StopsSoonWhenAsked) {
  const std::atomic<bool> stop{true};
  RunOptions options;
  options.stop = &stop;
  const MechanicsResult result = run_mechanics(coarse_scene(), options);
  EXPECT_EQ(result.status, RunStatus::interrupted);
  EXPECT_LT(result.steps, 100u);
}

// Whatever their order; the first is of the state at rest, the last of the end.
TEST(RunMechanics, TakesSnapshotsFromTheInitialStateToTheFinalOne) {
  scene::Scene scene = coarse_scene();
  scene.load.duration = 6e-3;
  scene.output.snapshot_times = {6e-3, 0.0, 5e-3, 2e-3};
  const MechanicsResult result = run_mechanics(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << result.reason;
  ASSERT_EQ(result.snapshots.size(), 4u);
  EXPECT_EQ(result.snapshots[0].time, 0.0);
  EXPECT_NEAR(result.snapshots[1].time, 2e-3, 1e-5);
  EXPECT_NEAR(result.snapshots[2].time, 5e-3, 1e-5);
  EXPECT_EQ(result.snapshots[3].time, result.end_time);
  for (std::size_t i = 0; i < result.particles; ++i) {
    EXPECT_EQ(result.snapshots[0].velocity_x[i], 0.0);
    EXPECT_EQ(result.snapshots[0].von_mises[i], 0.0);
    EXPECT_EQ(result.snapshots[0].temperature[i], 300.0);
  }
  EXPECT_EQ(result.snapshots[2].x.size(), result.particles);
  // Pressure and friction have heated the bulk a little, adiabatic compression is not in its equation.
  for (const double temperature : result.snapshots[2].temperature) {
    EXPECT_GE(temperature, 300.0);
    EXPECT_LT(temperature, 301.0);
  }
}

/// Of the cell of a particle in a snapshot, per radian.
double volume_of_cell(const Snapshot& shot, std::size_t i) {
  return 4.0 * shot.half_length_x[i] * shot.half_length_r[i] * shot.r[i];
}

// The density is integrated from the velocities, the cells come from the places of the particles alone.
TEST(RunMechanics, CellsOfSnapshotsTileTheBodiesAndHoldTheParticlesMass) {
  scene::Scene scene = coarse_scene();
  scene.load.duration = 12e-3;
  scene.output.snapshot_times = {0.0, 12e-3};
  const MechanicsResult result = run_mechanics(scene);
  ASSERT_EQ(result.snapshots.size(), 2u);
  const Snapshot &rest = result.snapshots[0], &loaded = result.snapshots[1];
  ASSERT_EQ(rest.half_length_x.size(), result.particles);
  ASSERT_EQ(loaded.half_length_r.size(), result.particles);
  EXPECT_TRUE(loaded.burnt_share.empty());
  double area = 0.0, largest_change = 0.0;
  for (std::size_t i = 0; i < rest.x.size(); ++i) {
    area += 4.0 * rest.half_length_x[i] * rest.half_length_r[i];
    const double change = rest.density[i] / loaded.density[i] - 1.0;
    largest_change = std::max(largest_change, std::abs(change));
    EXPECT_NEAR(volume_of_cell(loaded, i) / volume_of_cell(rest, i) - 1.0, change, 1e-3) << i;
    const bool neighbours = i > 0 && loaded.body[i] == loaded.body[i - 1] && loaded.x[i] > loaded.x[i - 1];
    if (!neighbours) continue;
    const double overlap =
        loaded.x[i - 1] + loaded.half_length_x[i - 1] - loaded.x[i] + loaded.half_length_x[i];
    EXPECT_LT(std::abs(overlap), 2e-3 * loaded.half_length_x[i]) << i;
  }
  EXPECT_NEAR(area, 0.74 * 0.0775, 1e-12) << "of the half section of the shell";
  EXPECT_GT(largest_change, 5e-3) << "the load has compressed the charge";
}

/// What a snapshot of the end tells of the wall and of the bulk, which friction alone heats.
TEST(RunMechanics, TellsHowMuchOfTheWallYieldsAndTheHeatOfFrictionOverTheWork) {
  scene::Scene scene = coarse_scene();
  scene.steel().strength.a = 500e6;
  scene.output.snapshot_times = {18e-3};
  const MechanicsResult result = run_mechanics(scene);
  ASSERT_EQ(result.snapshots.size(), 1u);
  const Snapshot& end = result.snapshots.front();
  const std::vector<double>& strain = end.state.find("plastic_strain")->second;
  std::map<double, double> yielded;  // lengths of columns by their places, to a tenth of a millimetre
  double heat = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < end.x.size(); ++i) {
    const std::string& body = scene.bodies[static_cast<std::size_t>(end.body[i])].name;
    if (body == "wall" && strain[i] > yield_of_wall)
      yielded[std::round(1e4 * end.x[i])] = 2.0 * end.half_length_x[i];
    largest = std::max(largest, strain[i]);
    if (body == "charge")
      heat += 2.0 * std::numbers::pi * volume_of_cell(end, i) * end.density[i] *
              scene.charge().specific_heat * (end.temperature[i] - 300.0);
  }
  double length = 0.0;
  for (const auto& [place, column] : yielded) length += column;
  EXPECT_GT(result.yielded_wall, 0.05);
  EXPECT_LT(result.yielded_wall, 0.56);
  EXPECT_NEAR(result.yielded_wall / length, 1.0, 0.02);
  EXPECT_EQ(result.largest_plastic_strain(), largest);
  const EnergyBalance& energy = result.monitor.back().energy;
  EXPECT_NEAR(energy.charge_friction / heat, 1.0, 0.01);
  EXPECT_GT(energy.charge_work, 0.9 * (energy.viscous + energy.crack)) << "what it lost was done on it";
  EXPECT_EQ(result.friction_over_work(), energy.charge_friction / energy.charge_work);
  EXPECT_TRUE(std::isnan(MechanicsResult().friction_over_work()));
}

/// What the plan leaves out must not matter: conduction moves the bulk of the charge by less than the
/// friction there.
TEST(RunMechanics, ForcedConductionAndReactionChangeNoBulkTemperatureOfTheCharge) {
  scene::Scene scene = coarse_scene();
  scene.output.snapshot_times = {18e-3};
  const MechanicsResult without = run_mechanics(scene);
  scene.physics.conduction = scene.physics.bulk_reaction = scene::Switch::on;
  const MechanicsResult with = run_mechanics(scene);
  ASSERT_EQ(with.snapshots.size(), 1u);
  const Snapshot &a = without.snapshots.front(), &b = with.snapshots.front();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.temperature.size(); ++i)
    if (scene.bodies[static_cast<std::size_t>(a.body[i])].material == "charge")
      largest = std::max(largest, std::abs(a.temperature[i] - b.temperature[i]));
  EXPECT_GT(largest, 0.0);   // the terms did act
  EXPECT_LT(largest, 0.05);  // K; friction heats the bulk by up to 0.5 K
}

/// The skin changes nothing in the mechanics below ignition, so a run that carries it must give the traced
/// temperatures to the tolerance of the integrations (model section 6).
TEST(RunWithSkin, AgreesWithTheTracedTemperaturesBelowIgnition) {
  const scene::Scene scene = coarse_scene();
  for (const double gap : {0.0, 2e-4}) {
    const CaseResult with_skin = run_with_skin(scene, gap);
    const GapResult traced = evaluate_gap(scene, with_skin.mechanics.trace, gap);
    ASSERT_EQ(with_skin.mechanics.status, RunStatus::completed);
    ASSERT_EQ(with_skin.gaps.front().skin.temperature.size(), traced.skin.temperature.size());
    for (std::size_t i = 0; i < traced.skin.temperature.size(); ++i)
      ASSERT_NEAR(with_skin.gaps.front().skin.temperature[i], traced.skin.temperature[i], 2e-2);
    EXPECT_NEAR(with_skin.gaps.front().at_stations.temperature, traced.at_stations.temperature, 1e-3);
    EXPECT_NEAR(with_skin.gaps.front().air.taken, traced.air.taken, 1e-3 * traced.air.taken);
    EXPECT_EQ(with_skin.gaps.front().air.supplied, traced.air.supplied);
    EXPECT_EQ(traced.air.taken > 10.0 * traced.air.supplied,
              gap > 0.0);  // the reservoir gives what no compression can
  }
}

TEST(RunWithSkin, IgnitesWhenAndWhereTheTraceDoes) {
  scene::Scene scene = coarse_scene();
  scene.surface.localisation = 800.0;
  scene.charge().kinetics.ignition_temperature = 420.0;  // well inside the heating
  const CaseResult with_skin = run_with_skin(scene, 4e-4);
  const GapResult traced = evaluate_gap(scene, with_skin.mechanics.trace, 4e-4);
  ASSERT_TRUE(with_skin.gaps.front().skin.ignition.has_value());
  ASSERT_TRUE(traced.skin.ignition.has_value());
  EXPECT_EQ(with_skin.gaps.front().skin.ignition->station, traced.skin.ignition->station);
  EXPECT_NEAR(with_skin.gaps.front().skin.ignition->time, traced.skin.ignition->time, 1e-6);
}

}  // namespace
}  // namespace launchsafe::run
