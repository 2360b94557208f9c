// Runs through ignition under hard circumstances: every one completes with its balances, or says why not.
#include "burning_scenes.hpp"
#include "launchsafe/run/run_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>

namespace launchsafe::run {
namespace {

using test_support::burning_gap;

scene::Scene hard_column() { return test_support::burning_column(1.25e-3, 5e-3, 0.3e-3); }

/// A small shell with nose, wall and base.
scene::Scene hard_shell() {
  scene::Scene scene = hard_column();
  scene.bodies = {{"nose", "steel", 0.0, 0.01, 0.0, 0.015},
                  {"charge", "charge", 0.01, 0.03, 0.0, 0.01},
                  {"wall", "steel", 0.01, 0.03, 0.01, 0.015},
                  {"base", "steel", 0.03, 0.04, 0.0, 0.015}};
  scene.load.peak = 500e6;
  return scene;
}

const CombustionHistory& burnt(const CaseResult& result) { return *result.gaps.front().combustion; }

/// What every run that burnt must fulfil, however it ended.
void expect_sound(const scene::Scene& scene, const CaseResult& result) {
  ASSERT_TRUE(result.gaps.front().combustion.has_value())
      << "T max " << result.gaps.front().at_stations.temperature << " K, " << result.mechanics.reason;
  const CombustionHistory& c = burnt(result);
  EXPECT_EQ(c.end == CombustionEnd::broke_off, result.mechanics.status != RunStatus::completed);
  EXPECT_EQ(result.mechanics.reason.empty(), result.mechanics.status == RunStatus::completed);
  const auto finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  for (const auto* values : {&c.time, &c.burnt_mass, &c.burnt_depth, &c.gas_volume, &c.gas_temperature,
                             &c.pressure, &c.released, &c.kept_back, &c.brought, &c.reaction_degree})
    EXPECT_TRUE(finite(*values));
  EXPECT_LT(c.energy_residual, 1e-6);
  EXPECT_TRUE(std::is_sorted(c.burnt_mass.begin(), c.burnt_mass.end()));
  if (!c.burnt_mass.empty()) {
    EXPECT_LE(c.burnt_mass.back(), (1.0 + 1e-9) * mass_of(result.mechanics, "charge"));
    EXPECT_GE(*std::min_element(c.gas_temperature.begin(), c.gas_temperature.end()), 200.0);
    EXPECT_LE(*std::max_element(c.gas_temperature.begin(), c.gas_temperature.end()), 9000.0);
    EXPECT_GE(*std::min_element(c.kept_back.begin(), c.kept_back.end()), 0.0);
  }
  if (result.mechanics.status == RunStatus::completed) {
    EXPECT_LE(c.energy_drift, scene.numerics.energy_drift_limit);
  }
}

CaseResult expect_completed(const scene::Scene& scene, double gap = burning_gap) {
  const CaseResult result = run_with_skin(scene, gap);
  EXPECT_EQ(result.mechanics.status, RunStatus::completed)
      << to_string(result.mechanics.status) << ": " << result.mechanics.reason;
  expect_sound(scene, result);
  return result;
}

TEST(HardCombustion, ThreadsDoNotChangeABit) {
  for (const auto release : {scene::HeatRelease::to_burnt_temperature, scene::HeatRelease::full}) {
    scene::Scene scene = hard_shell();
    scene.combustion.release = release;
    RunOptions options;
    const CaseResult one = run_with_skin(scene, burning_gap, options);
    options.threads = 2;
    const CaseResult two = run_with_skin(scene, burning_gap, options);
    expect_sound(scene, one);
    ASSERT_TRUE(two.gaps.front().combustion.has_value());
    EXPECT_EQ(one.mechanics.steps, two.mechanics.steps);
    EXPECT_EQ(one.mechanics.trace.bottom_pressure, two.mechanics.trace.bottom_pressure);
    EXPECT_EQ(one.gaps.front().skin.temperature, two.gaps.front().skin.temperature);
    const CombustionHistory &a = burnt(one), &b = burnt(two);
    EXPECT_EQ(a.pressure, b.pressure);
    EXPECT_EQ(a.burnt_mass, b.burnt_mass);
    EXPECT_EQ(a.gas_volume, b.gas_volume);
    EXPECT_EQ(a.gas_temperature, b.gas_temperature);
    EXPECT_EQ(a.energy_residual, b.energy_residual);
    EXPECT_EQ(a.energy_drift, b.energy_drift);
  }
}

TEST(HardCombustion, BurnsInPlaneStrainAndInTheLab) {
  scene::Scene scene = hard_shell();
  scene.symmetry = scene::Symmetry::plane_strain;
  expect_completed(scene);
  scene = hard_shell();
  scene.frame = scene::Frame::lab;
  expect_completed(scene);
}

TEST(HardCombustion, BurnsInChargesThatSlideAndInSeveralParticlesACell) {
  scene::Scene scene = hard_shell();
  for (const char* body : {"nose", "wall", "base"}) {
    scene::Interface face;
    face.body = body;
    face.condition = scene::Condition::sliding;
    face.friction = 0.1;
    scene.interfaces.push_back(face);
  }
  expect_completed(scene);
  scene = hard_shell();
  scene.numerics.particles_per_cell = 2;
  expect_completed(scene);
}

TEST(HardCombustion, AGapOfNothingIgnitesByItsOwnHeatAndBurns) {
  scene::Scene scene = hard_column();
  scene.initial_temperature = scene.surface.air.initial_temperature = 650.0;
  scene.charge().kinetics.ignition_temperature = 651.0;
  const CaseResult result = expect_completed(scene, 0.0);
  EXPECT_GT(burnt(result).burnt_mass.back(), 0.0);
}

TEST(HardCombustion, IgnitesAsSoonAsTheLoadHasComeToTheBottom) {
  scene::Scene scene = hard_column();
  scene.charge().kinetics.ignition_temperature = 300.0 + 1e-9;
  scene.load.base = 5e6;
  const CaseResult result = expect_completed(scene);
  EXPECT_LT(result.gaps.front().skin.ignition->time, 5e-6);
  EXPECT_NEAR(result.mechanics.end_time, scene.combustion.duration, 5e-6);
}

TEST(HardCombustion, IgnitesInTheLastStepOfTheLaunch) {
  scene::Scene scene = hard_column();
  const double ignition = run_with_skin(scene, burning_gap).gaps.front().skin.ignition->time;
  // A launch that ends where this one ignited, to within a thousandth of a step.
  scene.load.duration = ignition + 1e-10;
  scene.output.trace_interval = 1e-5;
  const CaseResult result = expect_completed(scene);
  EXPECT_NEAR(result.mechanics.end_time, ignition + scene.combustion.duration, 1e-6);
  EXPECT_GT(burnt(result).burnt_mass.back(), 0.0);
  // Mean temperature of gas that is there, not of what is still to burn.
  EXPECT_GT(burnt(result).gas_temperature.front(), 500.0);
}

TEST(HardCombustion, EndsAtOnceWhereItMayNotGoOnForAStep) {
  scene::Scene scene = hard_column();
  scene.combustion.duration = 1e-15;
  const CaseResult brief = expect_completed(scene);
  EXPECT_EQ(burnt(brief).end, CombustionEnd::time);
  scene.combustion.duration = 1e-3;
  scene.combustion.stop_pressure = 1.0;
  const CaseResult weak = expect_completed(scene);
  EXPECT_EQ(burnt(weak).end, CombustionEnd::pressure);
  EXPECT_NEAR(weak.mechanics.end_time, brief.mechanics.end_time, 1e-6);
}

TEST(HardCombustion, AMeasuredCurveHoldsItsLastPressure) {
  scene::Scene scene = hard_column();
  scene.load.curve_time = {0.0, 5e-4, 1e-3};
  scene.load.curve_pressure = {1e5, 60e6, 80e6};
  scene.combustion.duration = 2e-3;
  const CaseResult result = expect_completed(scene);
  EXPECT_EQ(result.mechanics.trace.chamber_pressure.back(), 80e6);
}

TEST(HardCombustion, AFlameThatHasEatenItsBodyEndsTheRun) {
  scene::Scene scene = hard_column();
  scene.bodies = {{"front", "charge", 0.0, 0.02, 0.0, 5e-3},
                  {"rear", "charge", 0.02, 0.0225, 0.0, 5e-3},
                  {"base", "steel", 0.0225, 0.04, 0.0, 5e-3}};
  scene.charge().conductivity = 1e4 * scene.charge().conductivity;  // a hundred times the speed
  scene.combustion.duration = 50e-3;
  scene.combustion.stop_pressure = 1e11;
  const CaseResult result = expect_completed(scene);
  EXPECT_EQ(burnt(result).end, CombustionEnd::burnt_through);
  EXPECT_NEAR(burnt(result).burnt_depth.back(), 2.5e-3, 1e-12);
  EXPECT_LE(burnt(result).burnt_mass.back(), (1.0 + 1e-9) * 1717.0 * std::numbers::pi * 25e-6 * 2.5e-3);
  EXPECT_LT(result.mechanics.end_time, scene.combustion.duration);
}

TEST(HardCombustion, ChargeBodiesSideBySideOfWhichOneDoesNotReachTheBottom) {
  scene::Scene scene = hard_column();
  scene.bodies = {{"core", "charge", 0.0, 0.04, 0.0, 2.5e-3},
                  {"ring", "charge", 0.0, 0.035, 2.5e-3, 5e-3},
                  {"base", "steel", 0.04, 0.06, 0.0, 5e-3}};
  scene.load.peak = 400e6;
  // The ring stands on a ledge of steel: the core's skin alone ignites, and the core alone burns.
  scene.bodies.push_back({"ledge", "steel", 0.035, 0.04, 2.5e-3, 5e-3});
  const CaseResult one = expect_completed(scene);
  scene.bodies.pop_back();
  scene.bodies[1].x_end = 0.04;
  const CaseResult both = expect_completed(scene);
  EXPECT_GT(burnt(one).burnt_mass.back(), 0.0);
  EXPECT_NEAR(
      burnt(both).burnt_mass.back() / (1717.0 * std::numbers::pi * 25e-6 * burnt(both).burnt_depth.back()),
      1.0, 1e-6);
}

TEST(HardCombustion, AFlameThatOutrunsSoundIsRefused) {
  scene::Scene scene = hard_column();
  scene.charge().kinetics.frequency = 1e30;
  const CaseResult result = run_with_skin(scene, burning_gap);
  EXPECT_EQ(result.mechanics.status, RunStatus::flame_beyond_sound) << to_string(result.mechanics.status);
  expect_sound(scene, result);
}

TEST(HardCombustion, AFastFlameThroughAThinSkinTakesNoEndOfSteps) {
  scene::Scene scene = hard_column();
  scene.charge().kinetics.frequency = 1e24;
  scene.surface.skin_thickness = 1e-7;
  const CaseResult result = run_with_skin(scene, burning_gap);
  EXPECT_GT(burnt(result).skin_flame_speed, 10.0);
  EXPECT_LT(result.mechanics.steps, 1000000u);
  expect_sound(scene, result);
}

TEST(HardCombustion, AHeatOfReactionThatDoesNotReachT2DrivesNoFlame) {
  // From 320 to 784 K it takes 0.83 MJ/kg. Air that goes beyond T2 brings the skin there, and it alone burns.
  scene::Scene scene = hard_column();
  scene.charge().kinetics.heat_of_reaction = 4e5;
  scene.surface.exchange_time = 1e-6;
  const CaseResult result = expect_completed(scene);
  const CombustionHistory& c = burnt(result);
  EXPECT_EQ(c.skin_flame_speed, 0.0);
  EXPECT_EQ(c.bulk_flame_speed, 0.0);
  EXPECT_GT(c.burnt_mass.back(), 0.0);
  EXPECT_LE(c.burnt_depth.back(), (1.0 + 1e-12) * scene.surface.skin_thickness);
  EXPECT_LE(c.released.back(), 4e5 * c.burnt_mass.back());
}

TEST(HardCombustion, ACaseThatIsStoppedAfterIgnitionIsNotCompleted) {
  scene::Scene scene = hard_column();
  scene.combustion.duration = 1.0;
  scene.combustion.stop_pressure = 1e11;
  std::atomic<bool> stop = false;
  RunOptions options;
  options.stop = &stop;
  // Progress is called a few times a second. The launch of some hundredths of a second ends before; what
  // follows it has a thousandth of its time behind it then.
  double last = 0;
  options.progress = [&](double share) {
    if (share < last || share < 0.01) stop = true;
    last = share;
  };
  const CaseResult result = run_case(scene, options);
  EXPECT_EQ(result.mechanics.status, RunStatus::interrupted);
}

}  // namespace
}  // namespace launchsafe::run
