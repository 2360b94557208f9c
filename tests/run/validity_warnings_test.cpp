#include "launchsafe/run/run_case.hpp"
#include "run/sound_run.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace launchsafe::run {
namespace {

using test_support::shipped_scene, test_support::sound_run, test_support::take_exit;
using Names = std::vector<std::string>;

Names names_of(const std::vector<Warning>& warnings) {
  Names names;
  for (const Warning& each : warnings) names.push_back(each.name);
  return names;
}

/// What is changed of the shipped launch and its sound run, and the names of the warnings that this gives.
struct Judged {
  const char* what;
  Names warnings;
  std::function<void(scene::Scene&, MechanicsResult&)> change;
};

void expect_all(const std::vector<Judged>& launches) {
  for (const Judged& each : launches) {
    scene::Scene scene = shipped_scene();
    MechanicsResult run = sound_run();
    each.change(scene, run);
    EXPECT_EQ(names_of(validity_warnings(scene, run)), each.warnings) << each.what;
  }
}

TEST(ValidityWarnings, ASoundRunHasNone) {
  expect_all({{"as shipped", {}, [](auto&, auto&) {}},
              {"scaled inertia", {}, [](auto& scene, auto&) { scene.numerics.inertial_scaling = 16.0; }},
              {"beyond the extremes of sweep.toml", {}, [](auto& scene, auto& run) {
                 scene.load.peak = 700e6;
                 scene.charge().strength.initial_crack_radius = run.monitor[2].largest_crack_radius = 3e-3;
               }}});
}

TEST(ValidityWarnings, AComputationThatIsNotSound) {
  const double cell = shipped_scene().numerics.cell_size;
  expect_all({
      {"no monitor history", {"energy"}, [](auto&, auto& run) { run.monitor.clear(); }},
      {"a broken history",
       {"energy"},
       [](auto&, auto& run) { run.monitor[2].momentum = std::numeric_limits<double>::quiet_NaN(); }},
      {"nine samples", {}, [](auto&, auto& run) { run.trace.time.resize(9); }},
      {"two samples",
       {"cells"},
       [](auto&, auto& run) {
         run.trace.time = {0.0, 18e-3};
       }},
      {"faces that hardly overlap",
       {},
       [cell](auto&, auto& run) {
         run.interfaces = {{"base", 0.9e-3 * cell}};
       }},
      {"faces that overlap",
       {"cells"},
       [](auto&, auto& run) {
         run.interfaces = {{"wall", 0.0}, {"base", 26e-6}};
       }},
      {"a third of the wall yields", {}, [](auto&, auto& run) { run.yielded_wall = 0.186; }},
      {"more than a third of the wall yields",
       {"shell-yields"},
       [](auto&, auto& run) { run.yielded_wall = 0.187; }},
      {"bulk beyond ignition",
       {"bulk-reaction"},
       [](auto& scene, auto& run) {
         run.trace.friction.back() = 230.0 * 1717.0 * 1780.0;  // J/m3 that heat by 230 K
         scene.physics.bulk_reaction = scene::Switch::off;
       }},
      {"bulk beyond ignition that reacts",
       {},
       [](auto& scene, auto& run) {
         run.trace.friction.back() = 230.0 * 1717.0 * 1780.0;
         scene.physics.bulk_reaction = scene::Switch::on;
       }},
  });
  // One particle step in a thousand, whichever the limiter.
  for (const Limiter& each : limiters)
    for (const std::uint64_t count : {1000u, 1001u})
      expect_all({{each.name, count > 1000 ? Names{"limiters"} : Names{}, [&](auto&, auto& run) {
                     run.particles = run.steps = 1000;
                     run.limiters.*each.member = count;
                   }}});
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
      {"covered", {0, 5, 9, 11, 13, 18, 22}, {0.1, 20, 400, 496, 400, 80, 4}, ""},
      {"not over", {0, 5, 9, 11, 13, 18}, {0.1, 20, 400, 496, 400, 80}, "not over"},
      {"its last point dropped", {0, 5, 9, 11, 13, 17.999, 18}, {0.1, 20, 400, 496, 400, 80, 0}, "not over"},
      {"with quiet after it", {0, 5, 9, 11, 13, 17, 20, 50}, {0.1, 20, 400, 496, 400, 80, 2, 0.1}, ""},
      {"cut at its peak", {0, 5, 9, 18}, {0.1, 20, 100, 496}, "not over"},
      {"a gauge that saturates",
       {0, 5, 7, 9, 11, 13, 15, 18, 20},
       {0, 60, 240, 250, 250, 250, 240, 2, 2},
       "saturates"},
      {"breaks off as it rises", {0, 3, 5, 7, 8, 9, 9.5, 18}, {0, 5, 60, 240, 320, 390, 0, 0}, "breaks off"},
      {"no point near the peak", {0, 3, 6, 8.5, 13.5, 18, 20}, {0, 5, 120, 380, 390, 2, 2}, "no point for"},
      {"points between thousands read as decimals",
       {0, 3, 3.5, 4, 6, 8, 10, 12, 12.5, 18, 20},
       {0.5, 50, 68.7, 0.1, 0.3, 0.5, 0.3, 0.1, 68.6, 0.5, 0.5},
       "misread numbers"},
      {"begins under load", {0, 5, 11, 18, 20}, {60, 300, 496, 2, 2}, "begins with"},
      {"begins before the simulation",
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
  EXPECT_EQ(names_of(validity_warnings(scene, sound_run())), (Names{"bottom", "bottom"}));
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
  for (const auto& [share, warned] :
       {std::pair{0.84, false}, {0.301, false}, {1.199, false}, {0.299, true}, {1.201, true}, {0.04, true}})
    expect_all({{"", warned ? Names{"bottom"} : Names{}, [share](auto&, auto& run) {
                   for (double& pressure : run.trace.bottom_pressure) pressure *= share / 0.99;
                 }}});
  expect_all({{"only the peak counts: a base that slides may open before", {}, [](auto&, auto& late) {
                 std::fill_n(late.trace.bottom_pressure.begin(), 800, 101325.0);
               }}});
}

/// Sound takes 192 us through the 0.5 m of the shipped charge. The analytic load rises as sin^n to its peak.
/// Of measured curves of the same launch a step of 60 % of the peak is one wherever it stands.
TEST(ValidityWarnings, ALoadThatRisesWhileSoundRunsThroughTheCharge) {
  const auto analytic = [](double peak_time) {
    return [peak_time](auto& scene, auto&) {
      scene.load.shape = scene::LoadShape::power_exponential;
      scene.load.peak_time = peak_time;
    };
  };
  expect_all({{"0.5 ms", {"cells"}, analytic(0.5e-3)}, {"1.5 ms", {}, analytic(1.5e-3)}});
  for (const auto& [low, high] : {std::pair{150e6, 450e6}, {200e6, 400e6}}) {
    scene::Scene scene = shipped_scene();
    scene.load.curve_time = {0.0, 4e-3, 8e-3, 8.05e-3, 10e-3, 14e-3, 18e-3};
    scene.load.curve_pressure = {0.0, 0.5 * low, low, high, 496e6, 200e6, 50e6};
    const Names names = names_of(validity_warnings(scene, sound_run()));
    EXPECT_EQ(std::ranges::count(names, "cells"), high - low > 250e6 ? 1 : 0) << low;
  }
}

TEST(ValidityWarnings, CracksThatNoContinuumLawHolds) {
  const auto cracks = [](double cell, double initial, double largest, double viscous = 0, double work = 0) {
    return [=](auto& scene, auto& run) {
      scene.numerics.cell_size = cell;
      scene.charge().strength.initial_crack_radius = initial;
      run.monitor[2].largest_crack_radius = largest;
      run.monitor[2].energy.viscous = viscous;
      run.monitor[2].energy.crack = work;
    };
  };
  expect_all({
      {"more than ten flaws", {"large-cracks"}, cracks(2.5e-3, 10.5e-3, 10.5e-3)},
      {"six cells", {"cells"}, cracks(0.5e-3, 3e-3, 3e-3)},
      // Grown rather than given, it gives a warning where it worked: a twentieth of what viscosity took.
      {"grown to six cells", {}, cracks(0.5e-3, 30e-6, 3e-3, 3.5, 0.05 * 3.5)},
      {"grown to six cells with work", {"cells"}, cracks(0.5e-3, 30e-6, 3e-3, 3.5, 0.051 * 3.5)},
      // As they do without friction between their faces: by 4.4 mm in 18 ms.
      {"cracks that run away", {"large-cracks"}, cracks(1.25e-3, 30e-6, 4.43e-3, 3.4, 0.3 * 3.4)},
      {"that grow little", {}, cracks(1.25e-3, 30e-6, 0.4e-3, 3.4, 2.5)},
      // In the corner beside the wall, on cells of 0.3125 mm, with friction.
      {"in a corner", {}, cracks(1.25e-3, 30e-6, 0.769e-3, 3.4, 0.02)},
      {"larger than the charge",
       {"large-cracks"},
       [](auto& scene, auto& run) {
         scene.charge().strength.initial_crack_radius = run.monitor[1].largest_crack_radius = 3e-3;
         scene.bodies[1].x_begin = scene.bodies[1].x_end - 2e-3;
         for (double& pressure : run.trace.bottom_pressure) pressure *= 2.0 / 560.0;  // of so little charge
       }},
  });
}

/// Kinetic and internal energy as measured at these factors: see validity_warnings.cpp for what they do to T
/// max.
TEST(ValidityWarnings, InertiaScaledUntilItMatters) {
  struct Measured {
    double scaling, internal, kinetic;
    bool warned;
  };
  for (const Measured& each : {Measured{1, 7470, 5000, false},
                               {16, 7470, 18.7, false},
                               {100, 7950, 157, false},
                               {200, 9649, 459, true},
                               {1e4, 6340, 3460, true}})
    expect_all({{"", each.warned ? Names{"inertia"} : Names{}, [each](auto& scene, auto& run) {
                   scene.interfaces.clear();
                   scene.numerics.inertial_scaling = each.scaling;
                   run.monitor[1].energy.internal = each.internal;
                   run.monitor[2].energy.kinetic = each.kinetic;
                 }}});
}

TEST(ValidityWarnings, InertiaWhereItsEffectWasNotMeasured) {
  const auto with = [](bool slides, double all, double selective, double width = 0) {
    return [=](auto& scene, auto& run) {
      scene.interfaces.clear();
      if (slides)
        scene.interfaces = {{.body = "wall", .condition = scene::Condition::sliding, .friction = 0.1}};
      scene.numerics.inertial_scaling = all;
      scene.numerics.selective_inertia = selective;
      if (width > 0) scene.load.width = width;
      run.monitor[1].energy.kinetic = 1.0;  // far from what any charge is warned of
    };
  };
  expect_all({{"bonded", {}, with(false, 200.0, 1.0)},
              {"sliding, scaled", {}, with(true, 16.0, 1.0)},
              {"sliding, selective", {}, with(true, 1.0, 4.0)},
              {"sliding, scaled more", {"inertia"}, with(true, 17.0, 1.0)},
              {"sliding, more selective", {"inertia"}, with(true, 1.0, 4.1)},
              {"sliding, both", {"inertia"}, with(true, 16.0, 2.0)},
              {"a rise from 10 to 90 % in 0.6 ms", {}, with(false, 1.0, 4.0, 0.37e-3)},
              {"a faster rise", {"inertia"}, with(false, 1.0, 4.0, 0.75 * 0.37e-3)},
              {"a faster rise with true inertia", {}, with(false, 1.0, 1.0, 0.75 * 0.37e-3)}});
}

TEST(ValidityWarnings, CombustionNeedsTrueInertiaAndAKnownLoad) {
  scene::Scene scene = shipped_scene();
  CombustionHistory combustion;
  combustion.time = {17.7e-3, 18.7e-3};
  const auto clauses = [&] { return combustion_validity_warnings(scene, combustion).size(); };
  EXPECT_EQ(clauses(), 0u);
  scene.numerics.inertial_scaling = 1.5;
  EXPECT_EQ(clauses(), 1u);
  scene.numerics.inertial_scaling = 1.0;
  scene.numerics.selective_inertia = 4.0;
  EXPECT_EQ(clauses(), 1u);
  scene.numerics.selective_inertia = 1.0;
  // A decay behind an exit goes on; the last point of a record does not.
  scene.load.curve_time = {0.0, 18e-3};
  EXPECT_EQ(clauses(), 0u);
  take_exit(scene.load);
  EXPECT_EQ(clauses(), 1u);
  scene.load.curve_time = {0.0, 19e-3};
  EXPECT_EQ(clauses(), 0u);
  combustion.end = CombustionEnd::broke_off;
  EXPECT_EQ(clauses(), 1u);
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
  EXPECT_EQ(names(496e6, 18e-3), Names{});
  EXPECT_EQ(names(180e6, 18e-3), Names{"low-velocity"});
  EXPECT_EQ(names(800e6, 18e-3), Names{"high-velocity"});
  EXPECT_EQ(names(496e6, 12e-3), Names{"short-travel"});
  EXPECT_EQ(names(0.0, 18e-3), (Names{"low-velocity", "short-travel"}));
}

TEST(WarningKinds, HaveNamesOfTheirOwnAndSomeAreAcceptable) {
  Names acceptable;
  for (const WarningKind& kind : warning_kinds()) {
    EXPECT_EQ(std::ranges::count(warning_kinds(), kind.name, &WarningKind::name), 1) << kind.name;
    EXPECT_EQ(is_acceptable(kind.name), kind.acceptable) << kind.name;
    if (kind.acceptable) acceptable.push_back(kind.name);
  }
  EXPECT_EQ(acceptable,
            (Names{"low-velocity", "high-velocity", "short-travel", "shell-yields", "large-cracks"}));
  EXPECT_FALSE(is_acceptable("no such name"));
}

}  // namespace
}  // namespace launchsafe::run
