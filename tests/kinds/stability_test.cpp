#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/study/forecast.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string stability_head =
    "kind = \"stability\"\nscene = \"scene_155mm.toml\"\nnumerical_uncertainty = \"3 K\"\n"
    "gaps = \"0.01 cm\"\n";

std::string case_text(const std::string& keys, const std::string& name = "one") {
  return "[[case]]\ngroup = \"made\"\nname = \"" + name + "\"\nmust_hold = \"it holds\"\n" + keys + "\n";
}

/// A closed-form run that keeps all invariants.
run::MechanicsResult sound_mechanics(const scene::Scene& scene, double kelvin = 116.1) {
  run::MechanicsResult result = synthetic_mechanics(scene, kelvin);
  for (const scene::Material& material : scene::used_materials(scene))
    add_mass(result.masses, material.name, scene::mass_of(scene, material.name));
  result.monitor.assign(2, {});
  result.monitor[1].time = result.end_time;
  result.monitor[1].energy.internal = result.monitor[1].energy.external = 100.0;
  result.monitor[1].energy.plastic = 5.0;
  return result;
}

using Mechanics = std::function<run::MechanicsResult(const scene::Scene&)>;

StudyOptions options_with(Mechanics mechanics) {
  StudyOptions options;
  options.jobs = 2;
  options.runners.mechanics = [mechanics = std::move(mechanics)](const scene::Scene& scene,
                                                                 const run::RunOptions&) {
    return mechanics(scene);
  };
  return options;
}

/// The one row of a study of one case.
StressCaseRow row_of(const std::string& keys, Mechanics mechanics) {
  const StabilityResult result = run_stability(
      study_of(stability_head + case_text(keys) + synthetic_constants), options_with(std::move(mechanics)));
  EXPECT_EQ(result.rows.size(), 1u);
  return result.rows.empty() ? StressCaseRow{} : result.rows.front();
}

/// A sound run with something broken in it.
template <class Break>
StressCaseRow row_of_broken(Break&& spoil, const std::string& keys = {}) {
  return row_of(keys, [&](const scene::Scene& scene) {
    run::MechanicsResult result = sound_mechanics(scene);
    spoil(result);
    return result;
  });
}

void expect_outcome(const StressCaseRow& row, Outcome outcome, const std::string& part) {
  EXPECT_EQ(row.finding.outcome, outcome) << row.finding.text;
  EXPECT_NE(row.finding.text.find(part), std::string::npos) << row.finding.text;
}

TEST(Stability, ASoundRunIsHeld) {
  const StressCaseRow row = row_of("", [](const scene::Scene& scene) { return sound_mechanics(scene); });
  expect_outcome(row, Outcome::held, "SAFE");
  EXPECT_TRUE(row.is_as_expected());
  EXPECT_TRUE(row.violations.empty());
}

// What a broken but plausible run must be called: every one of these has a finite T max and would be SAFE.
TEST(Stability, EveryBrokenInvariantUnderASafeVerdictIsWrong) {
  using run::MechanicsResult;
  const std::vector<std::pair<std::string, std::function<void(MechanicsResult&)>>> breaks{
      {"mass of charge", [](MechanicsResult& r) { r.masses.at(1).mass *= 1.0 + 1e-9; }},
      {"mass of steel", [](MechanicsResult& r) { r.masses.at(0).mass *= 0.999; }},
      {"momentum", [](MechanicsResult& r) { r.monitor[1].momentum = 1e3; }},
      {"energy drifts", [](MechanicsResult& r) { r.monitor[1].energy.external = 90.0; }},
      {"plastic dissipation falls", [](MechanicsResult& r) { r.monitor[0].energy.plastic = 6.0; }},
      {"crack dissipation falls", [](MechanicsResult& r) { r.monitor[1].energy.crack = -1.0; }},
      {"viscous dissipation falls", [](MechanicsResult& r) { r.monitor[1].energy.viscous = -1.0; }},
      {"friction heat falls", [](MechanicsResult& r) { r.trace.friction[1][400] = 0.0; }},
      {"the skin falls", [](MechanicsResult& r) {
         // Friction that cools.
         for (auto& energy : r.trace.friction[0]) energy = -energy;
       }}};
  for (const auto& [part, spoil] : breaks) {
    const StressCaseRow row = row_of_broken(spoil);
    expect_outcome(row, Outcome::wrong, part);
    EXPECT_TRUE(row.is_wrong());
    EXPECT_FALSE(row.is_as_expected());
  }
}

TEST(Stability, ATemperatureOffTheSafeComputationIsWrong) {
  const auto off_by = [](double kelvin) {
    return row_of("against = { numerics.time_step_factor = 0.1 }", [kelvin](const scene::Scene& scene) {
      return sound_mechanics(scene, scene.numerics.time_step_factor == 0.1 ? 80.0 : 80.0 - kelvin);
    });
  };
  expect_outcome(off_by(2.0), Outcome::held, "against the safe computation");
  expect_outcome(off_by(5.0), Outcome::wrong, "off the safe computation by 4.97 K, more than 3 K");
  expect_outcome(off_by(-5.0), Outcome::wrong, "off the safe computation by 4.97 K, more than 3 K");
}

TEST(Stability, OffButSayingSoIsDegraded) {
  // 5 K off, and without a history, which makes the verdict indeterminate.
  const StressCaseRow row =
      row_of("against = { numerics.time_step_factor = 0.1 }", [](const scene::Scene& scene) {
        run::MechanicsResult result =
            sound_mechanics(scene, scene.numerics.time_step_factor == 0.1 ? 85.0 : 80.0);
        if (scene.numerics.time_step_factor != 0.1) result.monitor.clear();
        return result;
      });
  expect_outcome(row, Outcome::degraded, "no monitor history");
}

TEST(Stability, AnIgnitionThatTheSafeComputationDoesNotHaveIsWrong) {
  const StressCaseRow row =
      row_of("against = { numerics.time_step_factor = 0.1 }", [](const scene::Scene& scene) {
        return sound_mechanics(scene, scene.numerics.time_step_factor == 0.1 ? 80.0 : 300.0);
      });
  expect_outcome(row, Outcome::wrong, "UNSAFE");
}

// Beyond ignition two computations say the same, however hot the skin would get.
TEST(Stability, TemperaturesAreComparedUpToIgnition) {
  const StressCaseRow row =
      row_of("against = { numerics.time_step_factor = 0.1 }", [](const scene::Scene& scene) {
        return sound_mechanics(scene, scene.numerics.time_step_factor == 0.1 ? 900.0 : 700.0);
      });
  expect_outcome(row, Outcome::held, "UNSAFE");
}

TEST(Stability, ValidityWarningsLimitersAndBrokenTemperaturesDegrade) {
  expect_outcome(row_of_broken([](run::MechanicsResult& r) { r.monitor.clear(); }), Outcome::degraded,
                 "no monitor history");
  expect_outcome(row_of_broken([](run::MechanicsResult& r) { r.limiters.tension_cutoff = 7; }),
                 Outcome::degraded, "limiters acted: tension cut-off 7");
  expect_outcome(row_of_broken([](run::MechanicsResult& r) {
                   r.trace.mean_bottom_pressure[100] = std::numeric_limits<double>::quiet_NaN();
                 }),
                 Outcome::degraded, "not finite");
}

TEST(Stability, AStoppedRunIsCaughtAndALateOneSaysSo) {
  const auto stopped = [](run::MechanicsResult& r) {
    r.status = run::RunStatus::energy_drift;
    r.reason = "at t = 1 ms: 80 %";
    r.steps = 640;
  };
  expect_outcome(row_of_broken(stopped), Outcome::caught, "energy drift after 640 steps, at t = 1 ms");
  expect_outcome(row_of_broken(stopped, "caught_within = 640"), Outcome::caught, "640");
  const StressCaseRow late = row_of_broken(stopped, "caught_within = 100\nexpect = \"caught\"");
  expect_outcome(late, Outcome::degraded, "caught late, 100 steps");
  EXPECT_FALSE(late.is_as_expected());
}

TEST(Stability, WhatIsExpectedAndDoesNotComeIsNotAsExpected) {
  const StabilityResult result = run_stability(
      study_of(stability_head + case_text("expect = [\"caught\", \"degraded\"]") + synthetic_constants),
      options_with([](const scene::Scene& scene) { return sound_mechanics(scene); }));
  EXPECT_EQ(result.unexpected(), 1u);
  EXPECT_EQ(result.wrong(), 0u);
  EXPECT_EQ(result.count(Outcome::held), 1u);
}

TEST(Stability, ARunThatThrowsIsARowThatWasNotComputed) {
  const StabilityResult result =
      run_stability(study_of(stability_head + case_text("set = { load.peak = \"400 MPa\" }", "broken") +
                             case_text("", "sound") + synthetic_constants),
                    options_with([](const scene::Scene& scene) {
                      if (scene.load.peak == 400e6) throw std::runtime_error("no more");
                      return sound_mechanics(scene);
                    }));
  EXPECT_EQ(result.failed(), 1u);
  EXPECT_EQ(result.rows[0].failure, "the run failed: no more");
  EXPECT_FALSE(result.rows[0].is_wrong());
  EXPECT_EQ(result.rows[1].finding.outcome, Outcome::held);
}

TEST(Stability, WhatTheReaderTakesThoughItMustNotIsWrong) {
  const std::string reader = "refused = \"to 2\"\nset = { numerics.time_step_factor = ";
  const StabilityResult result =
      run_stability(study_of(stability_head + case_text("") + case_text(reader + "3 }", "too long") +
                             case_text(reader + "1 }", "fine") +
                             case_text("refused = \"to 2\"\nset = { load.peak = \"11 GPa\" }", "another") +
                             synthetic_constants),
                    options_with([](const scene::Scene& scene) { return sound_mechanics(scene); }));
  ASSERT_EQ(result.rows.size(), 4u);
  expect_outcome(result.rows[1], Outcome::caught, "refused before anything was computed");
  expect_outcome(result.rows[2], Outcome::wrong, "the reader took the scene");
  expect_outcome(result.rows[3], Outcome::wrong, "not for \"to 2\"");
}

TEST(Stability, TheImpulseOfTheLoadIsTheMomentumInTheLabFrame) {
  const StudyFile study =
      study_of(stability_head + case_text("set = { frame = \"lab\" }") + synthetic_constants);
  const scene::Scene& scene = study.cases[0].scene.scene;
  // Simpson's rule on the load in closed form.
  const scene::PressureHistory load(scene.load);
  double impulse = 0;
  for (int i = 0; i < 1000; ++i) {
    const double begin = 18e-6 * i, end = 18e-6 * (i + 1);
    impulse += 18e-6 / 6.0 * (load.at(begin) + 4.0 * load.at(0.5 * (begin + end)) + load.at(end));
  }
  impulse *= scene::base_area(scene);
  run::MechanicsResult run = sound_mechanics(scene);
  run.monitor[1].momentum = -impulse;
  EXPECT_TRUE(violations_of(scene, run, {1e-4}).empty());
  run.monitor[1].momentum = -1.01 * impulse;
  EXPECT_EQ(violations_of(scene, run, {1e-4}).size(), 1u);
}

/// A closed-form run through ignition that keeps all invariants: 1 g of the charge, to T2.
run::CaseResult sound_burn(const scene::Scene& scene) {
  run::CaseResult result;
  result.mechanics = sound_mechanics(scene);
  result.gaps.resize(1);
  run::CombustionHistory c;
  c.time = {17.7e-3, 18.7e-3};
  c.burnt_mass = {0.0, 1e-3};
  c.burnt_depth = {0.0, 1e-4};
  c.gas_volume = {0.0, 1e-6};
  c.gas_temperature = {784.0, 784.0};
  c.pressure = {4e8, 5e8};
  c.released = {0.0, 500.0};
  c.kept_back = {0.0, 5320.0};
  c.brought = {0.0, 300.0};
  result.gaps[0].combustion = c;
  return result;
}

scene::Scene burning_scene() {
  return study_of(stability_head + case_text("set = { coupling = \"two-way\" }") + synthetic_constants)
      .cases[0]
      .scene.scene;
}

TEST(StabilityBurns, ASoundOneIsHeld) {
  const scene::Scene scene = burning_scene();
  const Finding finding = judge_burn(scene, 4e-4, sound_burn(scene));
  EXPECT_EQ(finding.outcome, Outcome::held) << finding.text;
  EXPECT_NE(finding.text.find("burnt 1 g"), std::string::npos) << finding.text;
}

TEST(StabilityBurns, EveryBrokenInvariantIsWrong) {
  using run::CombustionHistory;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(CombustionHistory&)>>> breaks{
      {"not finite", [&](CombustionHistory& c) { c.pressure[1] = none; }},
      {"not finite", [&](CombustionHistory& c) { c.skin_flame_speed = none; }},
      {"no history", [](CombustionHistory& c) { c = {}; }},
      {"made or lost 1.1 %", [](CombustionHistory& c) { c.energy_residual = 0.011; }},
      {"made or lost", [&](CombustionHistory& c) { c.energy_residual = none; }},
      {"energy drifts", [](CombustionHistory& c) { c.energy_drift = 0.5; }},
      {"of a charge of", [](CombustionHistory& c) { c.burnt_mass[1] = 1e3; }},
      {"the burnt mass falls", [](CombustionHistory& c) { c.burnt_mass[0] = 2e-3; }},
      {"J released of", [](CombustionHistory& c) { c.released[1] = 5830.0; }},
      {"the gas is between", [](CombustionHistory& c) { c.gas_temperature[0] = 0.0; }},
      {"the gas is between", [](CombustionHistory& c) { c.gas_temperature[1] = 9001.0; }}};
  const scene::Scene scene = burning_scene();
  for (const auto& [part, spoil] : breaks) {
    run::CaseResult result = sound_burn(scene);
    spoil(*result.gaps[0].combustion);
    const Finding finding = judge_burn(scene, 4e-4, result);
    EXPECT_EQ(finding.outcome, Outcome::wrong) << part << ": " << finding.text;
    EXPECT_NE(finding.text.find(part), std::string::npos) << finding.text;
  }
}

TEST(StabilityBurns, WhatBreaksOffIsCaughtAndWhatDoesNotIgniteOrHasScaledInertiaIsDegraded) {
  scene::Scene scene = burning_scene();
  run::CaseResult result = sound_burn(scene);
  result.mechanics.status = run::RunStatus::outside_gas_law;
  EXPECT_EQ(judge_burn(scene, 4e-4, result).outcome, Outcome::wrong);  // without a reason
  result.mechanics.reason = "at 18 ms";
  EXPECT_EQ(judge_burn(scene, 4e-4, result).outcome, Outcome::caught);
  result = sound_burn(scene);
  result.gaps[0].combustion.reset();
  EXPECT_EQ(judge_burn(scene, 4e-4, result).outcome, Outcome::degraded);
  scene.numerics.inertial_scaling = 4.0;
  EXPECT_EQ(judge_burn(scene, 4e-4, sound_burn(scene)).outcome, Outcome::degraded);
}

TEST(StabilityBurns, TheWorstFindingCounts) {
  const Finding held{Outcome::held, "fine"};
  EXPECT_EQ(joined_finding(held, {}).outcome, Outcome::held);
  EXPECT_EQ(joined_finding(held, {{1e-4, {Outcome::caught, "a"}}, {2e-4, {Outcome::degraded, "b"}}}).outcome,
            Outcome::caught);
  EXPECT_EQ(joined_finding({Outcome::degraded, "c"}, {{1e-4, held}}).outcome, Outcome::degraded);
  const Finding wrong = joined_finding(held, {{1e-4, {Outcome::wrong, "w"}}, {2e-4, held}});
  EXPECT_EQ(wrong.outcome, Outcome::wrong);
  EXPECT_EQ(wrong.text, "fine; w; fine");
}

TEST(Stability, ACaseWithTwoWayCouplingRunsEveryGapThroughIgnition) {
  StudyOptions options = options_with([](const scene::Scene& scene) { return sound_mechanics(scene); });
  std::atomic<int> burns{0};
  options.runners.with_skin = [&burns](const scene::Scene& scene, double, const run::RunOptions&) {
    ++burns;
    run::CaseResult result = sound_burn(scene);
    result.gaps[0].combustion->energy_residual = 0.5;
    return result;
  };
  const std::string burning = "set = { coupling = \"two-way\", gap.thickness = \"0.01, 0.02 cm\" }";
  const StudyFile study =
      study_of(stability_head + case_text("", "one-way") +
               case_text(burning + "\nagainst = { numerics.time_step_factor = 0.1 }", "two-way") +
               synthetic_constants);
  EXPECT_EQ(forecast_study(study, options, 1e6).runs.size(), 5u);
  const StabilityResult result = run_stability(study, options);
  EXPECT_EQ(burns, 2);
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_EQ(result.rows[0].finding.outcome, Outcome::held) << result.rows[0].finding.text;
  expect_outcome(result.rows[1], Outcome::wrong,
                 "through ignition at 0.02 cm: burning particles made or lost");
}

class StoredStability : public launchsafe::testing::TemporaryFolder {
 protected:
  StabilityResult run(const StudyFile& study, std::atomic<int>& runs) {
    auto store = store::CaseStore::open(folder() / "results", {"", run::model_version, {}});
    StudyOptions options = options_with([&runs](const scene::Scene& scene) {
      ++runs;
      return sound_mechanics(scene);
    });
    options.store = store->get();
    StabilityResult result = run_stability(study, options);
    EXPECT_FALSE((*store)->flush());
    return result;
  }
};

TEST_F(StoredStability, ComputesNothingASecondTimeAndSharesSafeComputations) {
  const std::string against = "against = { numerics.time_step_factor = 0.1 }";
  const StudyFile study = study_of(stability_head + case_text(against) +
                                   case_text("set = { numerics.time_step_factor = 0.3 }\n" + against, "two") +
                                   synthetic_constants);
  StudyOptions options;
  EXPECT_EQ(forecast_study(study, options, 1e6).runs.size(), 3u);
  std::atomic<int> first{0}, second{0};
  const StabilityResult fresh = run(study, first), again = run(study, second);
  EXPECT_EQ(first, 3);
  EXPECT_EQ(second, 0);
  EXPECT_EQ(again.timing.reused, 3u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(again.rows[i].finding.text, fresh.rows[i].finding.text);
}

}  // namespace
