#include "launchsafe/run/run_case.hpp"
#include "run/sound_run.hpp"

namespace launchsafe::run {
namespace {

using test_support::expect_one, test_support::shipped_scene, test_support::sound_run, test_support::take_exit;

/// Expects one clause that has `part`.
void expect_clause(const std::vector<std::string>& clauses, const std::string& part) {
  ASSERT_EQ(clauses.size(), 1u);
  EXPECT_NE(clauses[0].find(part), std::string::npos) << clauses[0];
}

TEST(ValidityWarnings, CombustionNeedsTrueInertiaAndAKnownLoad) {
  scene::Scene scene = shipped_scene();
  CombustionHistory combustion;
  combustion.time = {17.7e-3, 18.7e-3};
  EXPECT_TRUE(combustion_validity_warnings(scene, combustion).empty());
  scene.numerics.inertial_scaling = 1.5;
  expect_clause(combustion_validity_warnings(scene, combustion), "1.5");
  scene.numerics.inertial_scaling = 1.0;
  scene.numerics.selective_inertia = 4.0;
  expect_clause(combustion_validity_warnings(scene, combustion), "16");
  scene.numerics.selective_inertia = 1.0;
  // A decay behind an exit goes on; the last point of a record does not.
  scene.load.curve_time = {0.0, 18e-3};
  EXPECT_TRUE(combustion_validity_warnings(scene, combustion).empty());
  take_exit(scene.load);
  expect_clause(combustion_validity_warnings(scene, combustion), "0.7 ms");
  scene.load.curve_time = {0.0, 19e-3};
  EXPECT_TRUE(combustion_validity_warnings(scene, combustion).empty());
  combustion.end = CombustionEnd::broke_off;
  combustion.reason = "cells distorted";
  expect_clause(combustion_validity_warnings(scene, combustion), "cells distorted");
}

/// Kinetic and internal energy as measured at these factors: see validity_warnings.cpp for what they do to T
/// max.
TEST(ValidityWarnings, InertiaScaledUntilItMatters) {
  struct Measured {
    double scaling, internal, kinetic;
    bool warned;
  };
  for (const Measured& each : {Measured{16, 7470, 18.7, false},
                               {100, 7950, 157, false},
                               {200, 9649, 459, true},
                               {1e4, 6340, 3460, true}}) {
    scene::Scene scene = shipped_scene();
    scene.interfaces.clear();
    scene.numerics.inertial_scaling = each.scaling;
    MechanicsResult run = sound_run();
    run.monitor[1].energy.internal = each.internal;
    run.monitor[2].energy.kinetic = each.kinetic;
    EXPECT_EQ(!validity_warnings(scene, run).empty(), each.warned) << each.scaling;
  }
}

TEST(ValidityWarnings, TheInertiaThatAStepLoadMovesIsTrueWhereNothingScalesIt) {
  MechanicsResult run = sound_run();
  run.monitor[1].energy.kinetic = 5000.0;
  EXPECT_TRUE(validity_warnings(shipped_scene(), run).empty());
  scene::Scene scaled = shipped_scene();
  scaled.numerics.inertial_scaling = 4.0;
  expect_one(validity_warnings(scaled, run), "inertia", "4");
}

TEST(ValidityWarnings, ScaledInertiaOfAChargeThatSlidesBeyondWhatWasMeasured) {
  scene::Scene scene = shipped_scene();
  scene.interfaces.clear();
  const auto warnings_with = [&scene](double all, double selective) {
    scene.numerics.inertial_scaling = all;
    scene.numerics.selective_inertia = selective;
    MechanicsResult run = sound_run();
    run.monitor[1].energy.kinetic = 1.0;  // far from what any charge is warned of
    return validity_warnings(scene, run);
  };
  EXPECT_TRUE(warnings_with(200.0, 1.0).empty());
  scene.interfaces = {{.body = "wall", .condition = scene::Condition::sliding, .friction = 0.1}};
  EXPECT_TRUE(warnings_with(16.0, 1.0).empty());
  EXPECT_TRUE(warnings_with(1.0, 4.0).empty());
  expect_one(warnings_with(17.0, 1.0), "inertia", "16");
  expect_one(warnings_with(1.0, 4.1), "inertia", "16");
  expect_one(warnings_with(16.0, 2.0), "inertia", "16");
}

TEST(ValidityWarnings, SelectiveInertiaUnderALoadThatRisesFast) {
  scene::Scene scene = shipped_scene();
  scene.interfaces.clear();
  scene.load.width = 0.37e-3;  // from 10 to 90 % in 0.6 ms
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
  scene.numerics.selective_inertia = 4.0;
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
  scene.load.width = 0.75 * scene.load.width;
  expect_one(validity_warnings(scene, sound_run()), "inertia", "numerics.selective_inertia");
  scene.numerics.selective_inertia = 1.0;
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
}

}  // namespace
}  // namespace launchsafe::run
