// Runs through ignition under hard circumstances: every one completes with its balances, or says why not.
#include "burning_scenes.hpp"
#include "launchsafe/run/run_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

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
  for (const auto* values : {&c.time, &c.burnt_mass, &c.gas_volume, &c.gas_temperature, &c.pressure,
                             &c.released, &c.brought, &c.reaction_degree})
    EXPECT_TRUE(finite(*values));
  EXPECT_LT(c.energy_residual, 1e-6);
  EXPECT_TRUE(std::is_sorted(c.burnt_mass.begin(), c.burnt_mass.end()));
  if (!c.burnt_mass.empty()) {
    EXPECT_LE(c.burnt_mass.back(), (1.0 + 1e-9) * mass_of(result.mechanics, "charge"));
    EXPECT_GE(*std::min_element(c.gas_temperature.begin(), c.gas_temperature.end()), 200.0);
    EXPECT_LE(*std::max_element(c.gas_temperature.begin(), c.gas_temperature.end()), 9000.0);
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

TEST(HardCombustion, AMeasuredCurveHoldsItsLastPressure) {
  scene::Scene scene = hard_column();
  scene.load.curve_time = {0.0, 5e-4, 1e-3};
  scene.load.curve_pressure = {1e5, 60e6, 80e6};
  scene.combustion.duration = 2e-3;
  const CaseResult result = expect_completed(scene);
  EXPECT_EQ(result.mechanics.trace.chamber_pressure.back(), 80e6);
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
      burnt(both).burnt_mass.back() / (1717.0 * std::numbers::pi * 25e-6 * scene.surface.skin_thickness), 1.0,
      1e-6);
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
