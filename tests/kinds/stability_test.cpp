// What stress cases come to, on runs made by hand: one study of all of them, computed once.
#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/study/run_cases.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using run::CombustionHistory, run::MechanicsResult;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const std::string head =
    "kind = \"stability\"\nscene = \"scene_155mm.toml\"\ntemperature_tolerance = \"3 K\"\n"
    "gaps = \"0.01 cm\"\nlargest_gap = \"1 cm\"\n" +
    synthetic_constants;

std::string group_of(const std::string& cases) {
  return "[[group]]\nname = \"made\"\ncases = [\n" + cases + "]\n";
}

/// A closed-form run that keeps all invariants. Heated by 116.1 K it does not ignite.
MechanicsResult sound_mechanics(const scene::Scene& scene, double kelvin = 116.1) {
  MechanicsResult result = synthetic_mechanics(scene, kelvin);
  for (const scene::Material& material : scene::used_materials(scene))
    add_mass(result.masses, material.name, scene::mass_of(scene, material.name));
  result.monitor.assign(2, {});
  result.monitor[1].time = result.end_time;
  result.monitor[1].energy.internal = result.monitor[1].energy.external = 100.0;
  result.monitor[1].energy.plastic = 5.0;
  return result;
}

/// A closed-form run through ignition that keeps all invariants: 1 g of the charge, to T2.
run::CaseResult sound_burn(const scene::Scene& scene) {
  run::CaseResult result;
  result.mechanics = sound_mechanics(scene);
  result.gaps.resize(1);
  CombustionHistory& c = result.gaps[0].combustion.emplace();
  c.time = {17.7e-3, 18.7e-3};
  c.burnt_mass = {0.0, 1e-3};
  c.gas_volume = {0.0, 1e-6};
  c.gas_temperature = {784.0, 784.0};
  c.pressure = {4e8, 5e8};
  c.released = {0.0, 500.0};
  c.brought = {0.0, 300.0};
  return result;
}

/// Launches in closed form; runs through ignition are sound.
StudyOptions options_with(std::function<MechanicsResult(const scene::Scene&)> mechanics) {
  StudyOptions options;
  options.jobs = 2;
  options.runners = {
      [mechanics](const scene::Scene& scene, const run::RunOptions&) { return mechanics(scene); },
      [](const scene::Scene& scene, double, const run::RunOptions&) { return sound_burn(scene); }};
  return options;
}

/// Spoils a sound launch, or a sound run through ignition and what burnt in it.
using Spoil = std::function<void(MechanicsResult&, std::optional<CombustionHistory>&)>;

/// A case, what is broken in its run, and what it must come to.
struct Made {
  Outcome outcome = Outcome::held;
  std::string part = {};  ///< of the finding
  Spoil spoil = [](auto&, auto&) {};
  std::string keys = {};                      ///< of the case, after a comma
  std::string set = {};                       ///< scene keys of the case, after a comma
  double kelvin = 116.1, safe_kelvin = none;  ///< NaN: no safe computation
};

/// A study of made cases, whose runs are told apart by their time step factors. `coupled`: it is the runs
/// through ignition that are broken.
StabilityResult run_made(const std::vector<Made>& all, bool coupled) {
  std::string cases;
  std::map<double, const Made*> runs, safe_runs;
  for (const Made& made : all) {
    const double own = 0.3 + 0.002 * static_cast<double>(runs.size()), safe = own - 0.2;
    runs[own] = safe_runs[safe] = &made;
    cases += fmt::format("{{ name = \"{0}\", set = {{ numerics.time_step_factor = {0}{1}{2} }}{3}{4} }},\n",
                         own, coupled ? ", coupling = \"two-way\"" : "", made.set, made.keys,
                         std::isnan(made.safe_kelvin)
                             ? ""
                             : fmt::format(", against = {{ numerics.time_step_factor = {} }}", safe));
  }
  StudyOptions options = options_with([&](const scene::Scene& scene) {
    const double factor = scene.numerics.time_step_factor;
    if (const auto safe = safe_runs.find(factor); safe != safe_runs.end())
      return sound_mechanics(scene, safe->second->safe_kelvin);
    MechanicsResult result = sound_mechanics(scene, runs.at(factor)->kelvin);
    std::optional<CombustionHistory> nothing;
    if (!coupled) runs.at(factor)->spoil(result, nothing);
    return result;
  });
  options.runners.with_skin = [&](const scene::Scene& scene, double, const run::RunOptions&) {
    run::CaseResult result = sound_burn(scene);
    runs.at(scene.numerics.time_step_factor)->spoil(result.mechanics, result.gaps[0].combustion);
    return result;
  };
  return run_stability(study_of(head + group_of(cases)), options);
}

void expect_as_made(const std::vector<Made>& all, bool coupled = false) {
  const StabilityResult result = run_made(all, coupled);
  ASSERT_EQ(result.rows.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const StressCaseRow& row = result.rows[i];
    SCOPED_TRACE(all[i].part);
    EXPECT_EQ(to_string(row.finding.outcome), to_string(all[i].outcome))
        << row.finding.text << row.result.failure;
    EXPECT_NE(row.finding.text.find(all[i].part), std::string::npos) << row.finding.text;
    EXPECT_EQ(row.is_as_expected(), all[i].outcome != Outcome::wrong);
  }
}

TEST(Stability, ASoundRunIsHeld) { expect_as_made({Made{Outcome::held, "does not ignite"}}); }

/// Every one of these has a finite T max and no warning.
TEST(Stability, EveryBrokenInvariantWithoutAWarningIsWrong) {
  constexpr Outcome wrong = Outcome::wrong;
  const Spoil pushed = [](auto& m, auto&) { m.monitor[1].momentum = 1e3; };
  const Spoil cooled_by_friction = [](auto& m, auto&) {
    for (double& energy : m.trace.friction) energy = -energy;
  };
  expect_as_made({
      {wrong, "mass of charge", [](auto& m, auto&) { m.masses.at(1).mass *= 1.0 + 1e-9; }},
      {wrong, "mass of steel", [](auto& m, auto&) { m.masses.at(0).mass *= 0.999; }},
      {wrong, "momentum", pushed},
      {wrong, "energy drifts", [](auto& m, auto&) { m.monitor[1].energy.external = 90.0; }},
      {wrong, "plastic dissipation falls", [](auto& m, auto&) { m.monitor[0].energy.plastic = 6.0; }},
      {wrong, "crack dissipation falls", [](auto& m, auto&) { m.monitor[1].energy.crack = -1.0; }},
      {wrong, "viscous dissipation falls", [](auto& m, auto&) { m.monitor[1].energy.viscous = -1.0; }},
      {wrong, "friction heat falls", [](auto& m, auto&) { m.trace.friction[400] = 0.0; }},
      {wrong, "the skin falls", cooled_by_friction},
  });
}

TEST(Stability, ATemperatureOffTheSafeComputationIsWrongUpToIgnition) {
  const std::string off = "4.97 K";
  expect_as_made({
      {.part = "against the safe computation", .kelvin = 78.0, .safe_kelvin = 80.0},
      {.outcome = Outcome::wrong, .part = off, .kelvin = 75.0, .safe_kelvin = 80.0},
      {.outcome = Outcome::wrong, .part = off, .kelvin = 85.0, .safe_kelvin = 80.0},
      {.outcome = Outcome::wrong, .part = "ignites", .kelvin = 300.0, .safe_kelvin = 80.0},
      // Nothing is within 3 K of no number.
      {.outcome = Outcome::degraded, .kelvin = 80.0, .safe_kelvin = std::numeric_limits<double>::infinity()},
      // Beyond ignition two computations say the same, however hot the skin would get.
      {.part = "ignites", .kelvin = 700.0, .safe_kelvin = 900.0},
      // 5 K off, and without a history, which is a warning.
      {.outcome = Outcome::degraded,
       .part = "off the safe computation",
       .spoil = [](auto& m, auto&) { m.monitor.clear(); },
       .kelvin = 80.0,
       .safe_kelvin = 85.0},
  });
}

TEST(Stability, WhatSaysSoItselfIsDegradedAndWhatStopsIsCaught) {
  const Spoil stop = [](auto& m, auto&) {
    m.status = run::RunStatus::energy_drift;
    m.reason = "at t = 1 ms: 80 %";
    m.steps = 640;
  };
  expect_as_made({
      {Outcome::degraded, "no monitor history", [](auto& m, auto&) { m.monitor.clear(); }},
      {Outcome::degraded, "limiters acted: tension cut-off 7",
       [](auto& m, auto&) { m.limiters.tension_cutoff = 7; }},
      {Outcome::degraded, "not finite", [](auto& m, auto&) { m.trace.mean_bottom_pressure[100] = none; }},
      {Outcome::caught, "640 steps", stop},
      {Outcome::caught, "640 steps", stop, ", expect = \"caught\", caught_within = 640"},
      {Outcome::degraded, "caught late, 100 steps", stop,
       ", expect = \"caught, degraded\", caught_within = 100"},
  });
}

TEST(Stability, ARunThroughIgnitionThatBreaksAnInvariantIsWrong) {
  constexpr Outcome wrong = Outcome::wrong;
  const Spoil nothing = [](auto&, auto&) {};
  const Spoil leave_gas_law = [](auto& m, auto&) { m.status = run::RunStatus::outside_gas_law; };
  const Spoil with_reason = [leave_gas_law](auto& m, auto& c) {
    leave_gas_law(m, c);
    m.reason = "at 18 ms";
  };
  expect_as_made(
      {
          {Outcome::held, "burnt 1 g"},
          {wrong, "is not finite", [](auto&, auto& c) { c->pressure[1] = none; }},
          {wrong, "no history", [](auto&, auto& c) { c.emplace(); }},
          {wrong, "made or lost 1.1 %", [](auto&, auto& c) { c->energy_residual = 0.011; }},
          {wrong, "made or lost", [](auto&, auto& c) { c->energy_residual = none; }},
          {wrong, "energy drifts", [](auto&, auto& c) { c->energy_drift = 0.5; }},
          {wrong, "of a charge of", [](auto&, auto& c) { c->burnt_mass[1] = 1e3; }},
          {wrong, "the burnt mass falls", [](auto&, auto& c) { c->burnt_mass[0] = 2e-3; }},
          {wrong, "J released of", [](auto&, auto& c) { c->released[1] = 5830.0; }},
          {wrong, "the gas is between", [](auto&, auto& c) { c->gas_temperature[0] = 0.0; }},
          {wrong, "gas is between", [](auto&, auto& c) { c->gas_temperature[1] = 9001.0; }},
          {Outcome::degraded, "scaled by up to 4", nothing, "", ", numerics.inertial_scaling = 4"},
          {Outcome::degraded, "nothing ignited", [](auto&, auto& c) { c.reset(); }},
          {Outcome::caught, "at 18 ms", with_reason},
          {wrong, "without a reason", leave_gas_law},
      },
      true);
}

TEST(Stability, WhatIsNotExpectedNotComputedOrNotRefusedIsCounted) {
  const StudyFile study = study_of(
      head +
      group_of("{ name = \"unexpected\", expect = \"caught, degraded\" },\n"
               "{ name = \"thrown\", set = { load.peak = \"400 MPa\" } },\n"
               "{ name = \"too long\", refused = \"to 2\", set = { numerics.time_step_factor = 3 } },\n"
               "{ name = \"taken\", refused = \"to 2\", set = { numerics.time_step_factor = 1 } },\n"
               "{ name = \"for another\", refused = \"to 2\", set = { load.peak = \"11 GPa\" } },\n"));
  const auto throwing = [](const scene::Scene& scene) {
    if (scene.load.peak == 400e6) throw std::runtime_error("no more");
    return sound_mechanics(scene);
  };
  const std::vector<StressCaseRow> rows = run_stability(study, options_with(throwing)).rows;
  const std::vector<std::pair<std::string, std::string>> expected{{"held", "does not ignite"},
                                                                  {"", "the run failed: no more"},
                                                                  {"caught", "refused"},
                                                                  {"WRONG", "the reader took the scene"},
                                                                  {"WRONG", "not for \"to 2\""}};
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [outcome, part] = expected[i];
    EXPECT_EQ(rows[i].computed() ? to_string(rows[i].finding.outcome) : "", outcome);
    EXPECT_EQ(rows[i].is_as_expected(), outcome == "caught");
    EXPECT_NE((rows[i].finding.text + rows[i].result.failure).find(part), std::string::npos) << part;
  }
  const StudyOutcome outcome =
      run_study(study, options_with([](const scene::Scene& scene) { return sound_mechanics(scene); }));
  EXPECT_EQ(outcome.failures.size(), 3u) << "a case that is WRONG or not as expected fails the study";
}

TEST(Stability, ARunThatStopsAsExpectedIsTellingProgressOfNoFailure) {
  const StudyFile study = study_of(
      head +
      group_of("{ name = \"any\", set = { numerics.time_step_factor = 0.3 } },\n"
               "{ name = \"caught\", expect = \"caught\", set = { numerics.time_step_factor = 0.4 } },\n"
               "{ name = \"not so\", expect = \"held\", set = { numerics.time_step_factor = 0.5 } },\n"));
  StudyOptions options = options_with([](const scene::Scene& scene) {
    MechanicsResult result = sound_mechanics(scene);
    result.status = run::RunStatus::energy_drift;
    result.reason = "by hand";
    return result;
  });
  Progress told;
  options.progress = [&told](const Progress& progress) { told = progress; };
  run_stability(study, options);
  EXPECT_EQ(told.cases_done, 3u);
  EXPECT_EQ(told.cases_failed, 1u) << "the one that was to hold";
}

TEST(Stability, ACaseWithTwoWayCouplingRunsEveryGapThroughIgnitionAndTheWorstCounts) {
  StudyOptions options = options_with([](const scene::Scene& scene) { return sound_mechanics(scene); });
  std::atomic<int> burns{0};
  options.runners.with_skin = [&burns](const scene::Scene& scene, double gap, const run::RunOptions&) {
    ++burns;
    run::CaseResult result = sound_burn(scene);
    if (gap > 1.5e-4) result.gaps[0].combustion->energy_residual = 0.5;
    return result;
  };
  const StudyFile study = study_of(
      head +
      group_of("{ name = \"one-way\" },\n"
               "{ name = \"two-way\", set = { coupling = \"two-way\", gap.thickness = \"0.01, 0.02 cm\" }, "
               "against = { numerics.time_step_factor = 0.1 } },\n"));
  EXPECT_EQ(estimate_of(study, options).runs, 5u);
  const StabilityResult result = run_stability(study, options);
  EXPECT_EQ(burns, 2);
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_EQ(result.rows[0].finding.outcome, Outcome::held) << result.rows[0].finding.text;
  const Finding& worst = result.rows[1].finding;
  EXPECT_EQ(worst.outcome, Outcome::wrong) << worst.text;
  EXPECT_LT(worst.text.find("0.02 cm"), worst.text.find("0.01 cm: burnt 1 g")) << worst.text;
}

TEST(Stability, CasesShareTheirSafeComputation) {
  const StudyFile study = study_of(
      head +
      "[[group]]\nname = \"made\"\nagainst = { numerics.time_step_factor = 0.1 }\n"
      "cases = [{ name = \"one\" }, { name = \"two\", set = { numerics.time_step_factor = 0.3 } }]\n");
  EXPECT_EQ(study.cases.size(), 4u);
  EXPECT_EQ(estimate_of(study, {}).runs, 3u);
}

}  // namespace
