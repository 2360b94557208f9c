#include "launchsafe/run/run_case.hpp"
#include "run/sound_run.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace launchsafe::run {
namespace {

using test_support::expect_one, test_support::shipped_scene, test_support::sound_run, test_support::take_exit;

TEST(ValidityWarnings, ASoundRunHasNone) {
  scene::Scene scene = shipped_scene();
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
  scene.numerics.selective_inertia = 1.0;
  scene.numerics.inertial_scaling = 16.0;
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
  // The extremes of sweep_pressure_defect.toml.
  scene.load.peak = 700e6;
  scene.charge().strength.initial_crack_radius = 3e-3;
  MechanicsResult cracked = sound_run();
  cracked.monitor[2].largest_crack_radius = 3e-3;
  EXPECT_TRUE(validity_warnings(scene, cracked).empty());
}

TEST(ValidityWarnings, AMissingOrBrokenHistoryIsOne) {
  MechanicsResult run = sound_run();
  run.monitor.clear();
  expect_one(validity_warnings(shipped_scene(), run), "energy", "monitor");
  run = sound_run();
  run.monitor[2].momentum = std::numeric_limits<double>::quiet_NaN();
  expect_one(validity_warnings(shipped_scene(), run), "energy", "2");
}

/// A measured launch that is covered, or the word for what is not.
struct Measured {
  const char* name;
  std::vector<double> time, pressure;  ///< ms, MPa
  const char* said;                    ///< empty: covered
};

void expect_said(const std::function<void(scene::Load&)>& change, const std::string& said, const char* name) {
  scene::Scene scene = shipped_scene();
  change(scene.load);
  const auto warnings = validity_warnings(scene, sound_run());
  ASSERT_EQ(warnings.empty(), said.empty()) << name;
  if (said.empty()) return;
  EXPECT_EQ(warnings.front().name, "load") << name;
  EXPECT_NE(warnings.front().text.find(said), std::string::npos) << name << ": " << warnings.front().text;
}

TEST(ValidityWarnings, ALaunchThatIsNotSimulatedAsItIsStated) {
  expect_said([](auto&) {}, "", "as shipped: the shot leaves, and the load decays");
  expect_said([](auto& load) { take_exit(load); }, "", "until the load is over");
  expect_said([](auto& load) { load.peak_time = 15e-3; }, "", "a late peak, passed");
  expect_said([](auto& load) { load.duration = 9e-3; }, "not covered", "cut off while it rises");
  expect_said([](auto& load) { load.duration = load.peak_time; }, "cut short", "cut off at its peak");
  for (const double end : {14.7e-3, 15e-3, 18e-3})
    expect_said([end](auto& load) { load.duration = end; }, "cut short",
                "a duration before the decay is over");
  expect_said(
      [](auto& load) {
        take_exit(load);
        load.duration = 18e-3;
      },
      "cut short", "a duration without an exit");
  expect_said([](auto& load) { load.shape = scene::LoadShape::bell; }, "", "a bell that begins with 0.1 %");
  expect_said(
      [](auto& load) {
        load.shape = scene::LoadShape::bell;
        load.width = 4.6e-3;
      },
      "begins with", "a bell that begins with 1.2 %");
  const std::vector<Measured> launches{
      {"measured, covered", {0, 5, 9, 11, 13, 18, 22}, {0.1, 20, 400, 496, 400, 80, 4}, ""},
      {"measured, not over", {0, 5, 9, 11, 13, 18}, {0.1, 20, 400, 496, 400, 80}, "not over"},
      {"measured, its last point dropped",
       {0, 5, 9, 11, 13, 17.999, 18},
       {0.1, 20, 400, 496, 400, 80, 0},
       "not over"},
      {"measured, with quiet after it",
       {0, 5, 9, 11, 13, 17, 20, 50},
       {0.1, 20, 400, 496, 400, 80, 2, 0.1},
       ""},
      {"measured, cut at its peak", {0, 5, 9, 18}, {0.1, 20, 100, 496}, "not over"},
      {"measured, a gauge that saturates",
       {0, 5, 7, 9, 11, 13, 15, 18, 20},
       {0, 60, 240, 250, 250, 250, 240, 2, 2},
       "saturates"},
      {"measured, breaks off as it rises",
       {0, 3, 5, 7, 8, 9, 9.5, 18},
       {0, 5, 60, 240, 320, 390, 0, 0},
       "breaks off"},
      {"measured, no point near the peak",
       {0, 3, 6, 8.5, 13.5, 18, 20},
       {0, 5, 120, 380, 390, 2, 2},
       "no point for"},
      {"measured, points between thousands read as decimals",
       {0, 3, 3.5, 4, 6, 8, 10, 12, 12.5, 18, 20},
       {0.5, 50, 68.7, 0.1, 0.3, 0.5, 0.3, 0.1, 68.6, 0.5, 0.5},
       "misread numbers"},
      {"measured, begins under load", {0, 5, 11, 18, 20}, {60, 300, 496, 2, 2}, "begins with"},
      {"measured, begins before the simulation",
       {-6, -3, 0, 5, 11, 18, 20},
       {0, 60, 10, 300, 496, 2, 2},
       "before the start"},
  };
  for (const Measured& each : launches)
    expect_said(
        [&each](scene::Load& load) {
          take_exit(load);
          for (const double time : each.time) load.curve_time.push_back(1e-3 * time);
          for (const double pressure : each.pressure) load.curve_pressure.push_back(1e6 * pressure);
        },
        each.said, each.name);
}

TEST(ValidityWarnings, AFaceOfTheChargeThatNobodyLooksAt) {
  scene::Scene scene = shipped_scene();
  scene::Body ring = scene.bodies[1];
  scene.bodies[1].r_end = ring.r_begin = 0.03;
  ring.name = "ring";
  scene.bodies.push_back(ring);
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
  scene.bodies.back().x_end -= 1e-8;  // 10 nm
  // Beside it the warning that a bottom so small would have to bear more.
  const std::vector<Warning> warnings = validity_warnings(scene, sound_run());
  ASSERT_EQ(warnings.size(), 2u);
  for (const Warning& each : warnings) EXPECT_EQ(each.name, "bottom");
  EXPECT_NE(warnings[0].text.find("\"ring\" ends 1e-05 mm"), std::string::npos) << warnings[0].text;
  // More charge behind all of it is no face.
  scene.bodies.back().x_end = 0.6;
  scene::Body rear = scene.bodies.back();
  rear.name = "rear";
  rear.x_begin = 0.6;
  rear.x_end = 0.678;
  scene.bodies.push_back(rear);
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());
}

/// Charge mass times acceleration over the bottom's area is 140.843 MPa at 496 MPa: 1717 kg/m3 on 0.56 m
/// under 146479 m/s2. Bonded the shipped charge bears 0.84 of it, sliding 0.99 (measured).
TEST(ValidityWarnings, AChargeThatDoesNotBearWhatStaticsAsksOfIt) {
  const scene::Scene scene = shipped_scene();
  for (const auto& [share, said] : {std::pair{0.84, ""},
                                    {0.301, ""},
                                    {1.199, ""},
                                    {0.299, "140.8 MPa"},
                                    {1.201, "140.8 MPa"},
                                    {0.04, "base"}}) {
    MechanicsResult run = sound_run();
    for (double& pressure : run.trace.bottom_pressure) pressure *= share / 0.99;
    const auto warnings = validity_warnings(scene, run);
    ASSERT_EQ(warnings.empty(), std::string(said).empty()) << share;
    if (!warnings.empty()) expect_one(warnings, "bottom", said);
  }
  // Only the peak counts: a base that slides may open before.
  MechanicsResult late = sound_run();
  std::fill_n(late.trace.bottom_pressure.begin(), 800, 101325.0);
  EXPECT_TRUE(validity_warnings(scene, late).empty());
}

TEST(ValidityWarnings, ATraceOfTooFewSamples) {
  MechanicsResult run = sound_run();
  run.trace.time = {0.0, 18e-3};
  expect_one(validity_warnings(shipped_scene(), run), "cells", "2");
  run.trace.time.resize(9);
  EXPECT_TRUE(validity_warnings(shipped_scene(), run).empty());
}

/// Sound takes 192 us through the 0.5 m of the shipped charge. The analytic load rises as sin^n to its peak.
TEST(ValidityWarnings, ALoadThatRisesWhileSoundRunsThroughTheCharge) {
  scene::Scene scene = shipped_scene();
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.peak_time = 0.5e-3;
  expect_one(validity_warnings(scene, sound_run()), "cells", "192 µs");
  scene.load.peak_time = 1.5e-3;
  EXPECT_TRUE(validity_warnings(scene, sound_run()).empty());

  // Measured curves of the same launch: a step of 60 % of the peak is one wherever it stands, one of 40 %
  // none.
  const auto warns_of_a_step = [&](double low, double high) {
    scene.load.curve_time = {0.0, 4e-3, 8e-3, 8.05e-3, 10e-3, 14e-3, 18e-3};
    scene.load.curve_pressure = {0.0, 0.5 * low, low, high, 496e6, 200e6, 50e6};
    const auto warnings = validity_warnings(scene, sound_run());
    return std::ranges::find(warnings, "cells", &Warning::name) != warnings.end();
  };
  EXPECT_TRUE(warns_of_a_step(150e6, 450e6));
  EXPECT_FALSE(warns_of_a_step(200e6, 400e6));
}

TEST(ValidityWarnings, CracksThatNoContinuumLawHolds) {
  MechanicsResult run = sound_run();
  scene::Scene cracked = shipped_scene();
  cracked.numerics.cell_size = 2.5e-3;
  cracked.charge().strength.initial_crack_radius = run.monitor[1].largest_crack_radius = 10.5e-3;
  expect_one(validity_warnings(cracked, run), "large-cracks", "10.5");
  scene::Scene fine = shipped_scene();
  fine.numerics.cell_size = 0.5e-3;
  fine.charge().strength.initial_crack_radius = run.monitor[1].largest_crack_radius = 3e-3;
  expect_one(validity_warnings(fine, run), "cells", "6");
  // Grown rather than given, it gives a warning where it worked: a twentieth of what viscosity took.
  fine.charge().strength.initial_crack_radius = 30e-6;
  run.monitor[2].energy.viscous = 3.5;
  run.monitor[2].energy.crack = 0.05 * 3.5;
  EXPECT_EQ(validity_warnings(fine, run).size(), 0u);
  run.monitor[2].energy.crack = 0.051 * 3.5;
  expect_one(validity_warnings(fine, run), "cells", "6");
  run.monitor[2].energy.crack = 0.0;
  scene::Scene thin = shipped_scene();
  thin.charge().strength.initial_crack_radius = 3e-3;
  thin.bodies[1].x_begin = thin.bodies[1].x_end - 2e-3;
  for (double& pressure : run.trace.bottom_pressure) pressure *= 2.0 / 560.0;  // of so little charge
  expect_one(validity_warnings(thin, run), "large-cracks", "charge");
}

TEST(ValidityWarnings, FacesThatPassIntoEachOther) {
  const scene::Scene scene = shipped_scene();
  MechanicsResult run = sound_run();
  run.interfaces.resize(1);
  run.interfaces[0].body = "base";
  run.interfaces[0].overlap = {0.0, 0.9e-3 * scene.numerics.cell_size};
  EXPECT_TRUE(validity_warnings(scene, run).empty());
  run.interfaces[0].overlap[0] = 26e-6;
  expect_one(validity_warnings(scene, run), "cells", "\"base\"");
}

/// As they do without friction between their faces: by 4.4 mm in 18 ms.
TEST(ValidityWarnings, CracksThatRunAway) {
  MechanicsResult run = sound_run();
  run.monitor[2].largest_crack_radius = 4.43e-3;
  run.monitor[2].energy.viscous = 3.4;
  run.monitor[2].energy.crack = 2.5;
  expect_one(validity_warnings(shipped_scene(), run), "large-cracks", "4.4 mm");
  run.monitor[2].largest_crack_radius = 0.4e-3;
  EXPECT_TRUE(validity_warnings(shipped_scene(), run).empty());
  // In the corner beside the wall, on cells of 0.3125 mm, with friction.
  run.monitor[2].largest_crack_radius = 0.769e-3;
  run.monitor[2].energy.crack = 0.02;
  EXPECT_TRUE(validity_warnings(shipped_scene(), run).empty());
}

TEST(ValidityWarnings, ABulkAboveIgnitionWhoseReactionIsLeftOut) {
  scene::Scene scene = shipped_scene();
  MechanicsResult run = sound_run();
  run.trace.friction[0].back() = 230.0 * 1717.0 * 1780.0;  // J/m3 that heat by 230 K
  scene.physics.bulk_reaction = scene::Switch::off;
  expect_one(validity_warnings(scene, run), "bulk-reaction", "530 K");
  scene.physics.bulk_reaction = scene::Switch::on;
  EXPECT_TRUE(validity_warnings(scene, run).empty());
}

/// A third of the charge of 560 mm.
TEST(ValidityWarnings, AShellThatYields) {
  MechanicsResult run = sound_run();
  run.yielded_wall = 0.186;
  EXPECT_TRUE(validity_warnings(shipped_scene(), run).empty());
  run.yielded_wall = 0.187;
  expect_one(validity_warnings(shipped_scene(), run), "shell-yields", "187 mm");
}

/// One particle step in a thousand, whichever the limiter.
TEST(ValidityWarnings, LimitersThatActedOften) {
  MechanicsResult run = sound_run();
  run.particles = run.steps = 1000;
  for (const Limiter& each : limiters) {
    run.limiters = {};
    run.limiters.*each.member = 1000;
    EXPECT_TRUE(validity_warnings(shipped_scene(), run).empty()) << each.name;
    run.limiters.*each.member = 1001;
    expect_one(validity_warnings(shipped_scene(), run), "limiters", "1001");
  }
}

std::vector<std::string> names_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> names;
  for (const Warning& each : warnings) names.push_back(each.name);
  return names;
}

/// The shipped launch has 760 m/s after 5.36 m, 35 calibres. Both change in proportion to the peak pressure;
/// after 12 ms it has 519 m/s and 1.18 m.
TEST(LaunchWarnings, AProjectileThatIsSlowOrFastOrTravelsLittle) {
  const auto names = [](double peak, double exit) {
    scene::Scene scene = shipped_scene();
    scene.load.peak = peak;
    scene.load.muzzle_exit = exit;
    return names_of(launch_warnings(scene));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(496e6, 18e-3), Names{});
  EXPECT_EQ(names(180e6, 18e-3), Names{"low-velocity"});
  EXPECT_EQ(names(800e6, 18e-3), Names{"high-velocity"});
  EXPECT_EQ(names(496e6, 12e-3), Names{"short-travel"});
  EXPECT_EQ(names(0.0, 18e-3), (Names{"low-velocity", "short-travel"}));
}

TEST(WarningKinds, HaveNamesOfTheirOwnAndSomeAreAcceptable) {
  std::vector<std::string> acceptable;
  for (const WarningKind& kind : warning_kinds()) {
    EXPECT_EQ(std::ranges::count(warning_kinds(), kind.name, &WarningKind::name), 1) << kind.name;
    EXPECT_EQ(is_acceptable(kind.name), kind.acceptable) << kind.name;
    if (kind.acceptable) acceptable.push_back(kind.name);
  }
  EXPECT_LE(warning_kinds().size(), 14u);
  EXPECT_EQ(acceptable, (std::vector<std::string>{"low-velocity", "high-velocity", "short-travel",
                                                  "shell-yields", "large-cracks"}));
  EXPECT_FALSE(is_acceptable("no such name"));
}

}  // namespace
}  // namespace launchsafe::run
