// What stress cases come to, on runs made by hand: one study of all of them, computed once.
#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/study/forecast.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using run::CombustionHistory, run::MechanicsResult;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const std::string head =
    "kind = \"stability\"\nscene = \"scene_155mm.toml\"\nnumerical_uncertainty = \"3 K\"\n"
    "gaps = \"0.01 cm\"\n" +
    synthetic_constants;

std::string group_of(const std::string& cases) {
  return "[[group]]\nname = \"made\"\ncases = [\n" + cases + "]\n";
}

/// A closed-form run that keeps all invariants. Heated by 116.1 K it is SAFE.
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
  CombustionHistory c;
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

/// A case, what is broken in its run, and what it must come to.
struct Made {
  std::string name;
  Outcome outcome = Outcome::held;
  std::string part;       ///< of the finding
  std::string keys = {};  ///< of the case
  std::function<void(MechanicsResult&)> spoil = {};
  double kelvin = 116.1, safe_kelvin = none;  ///< NaN: no safe computation
  std::function<void(run::CaseResult&)> spoil_burn = {};
  std::string set = {};  ///< scene keys of the case
};

Made broken(std::string part, std::function<void(MechanicsResult&)> spoil, std::string keys = {},
            Outcome outcome = Outcome::wrong) {
  return {(outcome == Outcome::wrong ? "broken: " : "flagged: ") + part, outcome, part, std::move(keys),
          std::move(spoil)};
}

Made compared(const std::string& name, Outcome outcome, std::string part, double kelvin, double safe_kelvin) {
  return {"compared: " + name, outcome, std::move(part), {}, {}, kelvin, safe_kelvin};
}

Made burning(const std::string& name, Outcome outcome, std::string part,
             std::function<void(run::CaseResult&)> spoil, const std::string& set = {}) {
  return {"burning: " + name,
          outcome,
          std::move(part),
          {},
          {},
          116.1,
          none,
          std::move(spoil),
          ", coupling = \"two-way\"" + set};
}

Made burnt(const std::string& part, const std::function<void(CombustionHistory&)>& spoil) {
  return burning(part, Outcome::wrong, part, [spoil](run::CaseResult& r) { spoil(*r.gaps[0].combustion); });
}

void stop(MechanicsResult& r) {
  r.status = run::RunStatus::energy_drift;
  r.reason = "at t = 1 ms: 80 %";
  r.steps = 640;
}

const std::vector<Made>& made_cases() {
  static const std::vector<Made> all{
      {"sound", Outcome::held, "SAFE"},
      // Every one of these has a finite T max and would be SAFE.
      broken("mass of charge", [](MechanicsResult& r) { r.masses.at(1).mass *= 1.0 + 1e-9; }),
      broken("mass of steel", [](MechanicsResult& r) { r.masses.at(0).mass *= 0.999; }),
      broken("momentum", [](MechanicsResult& r) { r.monitor[1].momentum = 1e3; }),
      broken("energy drifts", [](MechanicsResult& r) { r.monitor[1].energy.external = 90.0; }),
      broken("plastic dissipation falls", [](MechanicsResult& r) { r.monitor[0].energy.plastic = 6.0; }),
      broken("crack dissipation falls", [](MechanicsResult& r) { r.monitor[1].energy.crack = -1.0; }),
      broken("viscous dissipation falls", [](MechanicsResult& r) { r.monitor[1].energy.viscous = -1.0; }),
      broken("friction heat falls", [](MechanicsResult& r) { r.trace.friction[1][400] = 0.0; }),
      broken("the skin falls",
             [](MechanicsResult& r) {
               for (double& energy : r.trace.friction[0]) energy = -energy;  // friction that cools
             }),
      // An invariant that the case does not name is not judged.
      broken(
          "SAFE", [](MechanicsResult& r) { r.monitor[1].momentum = 1e3; }, "invariants = \"finite, energy\"",
          Outcome::held),
      broken(
          "no monitor history", [](MechanicsResult& r) { r.monitor.clear(); }, "", Outcome::degraded),
      broken(
          "limiters acted: tension cut-off 7", [](MechanicsResult& r) { r.limiters.tension_cutoff = 7; }, "",
          Outcome::degraded),
      broken(
          "not finite", [](MechanicsResult& r) { r.trace.mean_bottom_pressure[100] = none; }, "",
          Outcome::degraded),
      broken("energy drift after 640 steps, at t = 1 ms", stop, "", Outcome::caught),
      broken("640 steps", stop, "caught_within = 640", Outcome::caught),
      broken("caught late, 100 steps", stop, "caught_within = 100", Outcome::degraded),
      compared("as the safe one", Outcome::held, "against the safe computation", 78.0, 80.0),
      compared("too cold", Outcome::wrong, "off the safe computation by 4.97 K, more than 3 K", 75.0, 80.0),
      compared("too hot", Outcome::wrong, "off the safe computation by 4.97 K, more than 3 K", 85.0, 80.0),
      compared("an ignition of its own", Outcome::wrong, "UNSAFE", 300.0, 80.0),
      // Beyond ignition two computations say the same, however hot the skin would get.
      compared("both ignite", Outcome::held, "UNSAFE", 700.0, 900.0),
      // 5 K off, and without a history, which makes the verdict indeterminate.
      {"compared: off, and says so",
       Outcome::degraded,
       "off the safe computation",
       {},
       [](MechanicsResult& r) { r.monitor.clear(); },
       80.0,
       85.0},
      burning("sound", Outcome::held, "burnt 1 g", [](run::CaseResult&) {}),
      burnt("is not finite", [](CombustionHistory& c) { c.pressure[1] = none; }),
      burnt("combustion is not finite", [](CombustionHistory& c) { c.skin_flame_speed = none; }),
      burnt("no history", [](CombustionHistory& c) { c = {}; }),
      burnt("made or lost 1.1 %", [](CombustionHistory& c) { c.energy_residual = 0.011; }),
      burnt("made or lost", [](CombustionHistory& c) { c.energy_residual = none; }),
      burnt("energy drifts", [](CombustionHistory& c) { c.energy_drift = 0.5; }),
      burnt("of a charge of", [](CombustionHistory& c) { c.burnt_mass[1] = 1e3; }),
      burnt("the burnt mass falls", [](CombustionHistory& c) { c.burnt_mass[0] = 2e-3; }),
      burnt("J released of", [](CombustionHistory& c) { c.released[1] = 5830.0; }),
      burnt("the gas is between", [](CombustionHistory& c) { c.gas_temperature[0] = 0.0; }),
      burnt("gas is between", [](CombustionHistory& c) { c.gas_temperature[1] = 9001.0; }),
      burning(
          "scaled inertia", Outcome::degraded, "inertia is scaled by 4", [](run::CaseResult&) {},
          ", numerics.inertial_scaling = 4"),
      burning("nothing ignited", Outcome::degraded, "nothing ignited",
              [](run::CaseResult& r) { r.gaps[0].combustion.reset(); }),
      burning("broke off", Outcome::caught, "outside of the gas law, at 18 ms",
              [](run::CaseResult& r) {
                r.mechanics.status = run::RunStatus::outside_gas_law;
                r.mechanics.reason = "at 18 ms";
              }),
      burning("no reason", Outcome::wrong, "without a reason",
              [](run::CaseResult& r) { r.mechanics.status = run::RunStatus::outside_gas_law; }),
  };
  return all;
}

/// The time step factor of a made case and of its safe computation, by which their runs are told apart.
double factor_of(std::size_t index, bool safe) {
  return (safe ? 0.1 : 0.3) + 0.002 * static_cast<double>(index);
}

std::string text_of(const Made& made, std::size_t i) {
  std::string text = fmt::format("{{ name = \"{}\", set = {{ numerics.time_step_factor = {}{} }}", made.name,
                                 factor_of(i, false), made.set);
  if (std::isfinite(made.safe_kelvin))
    text += fmt::format(", against = {{ numerics.time_step_factor = {} }}", factor_of(i, true));
  return text + (made.keys.empty() ? "" : ", ") + made.keys + " },\n";
}

StabilityResult compute_made() {
  std::string cases;
  std::map<double, const Made*> runs, safe_runs;
  const std::vector<Made>& all = made_cases();
  for (std::size_t i = 0; i < all.size(); ++i) {
    cases += text_of(all[i], i);
    runs[factor_of(i, false)] = &all[i];
    safe_runs[factor_of(i, true)] = &all[i];
  }
  StudyOptions options;
  options.jobs = 2;
  options.runners.mechanics = [&](const scene::Scene& scene, const run::RunOptions&) {
    const double factor = scene.numerics.time_step_factor;
    if (const auto safe = safe_runs.find(factor); safe != safe_runs.end())
      return sound_mechanics(scene, safe->second->safe_kelvin);
    const Made& made = *runs.at(factor);
    MechanicsResult result = sound_mechanics(scene, made.kelvin);
    if (made.spoil) made.spoil(result);
    return result;
  };
  options.runners.with_skin = [&](const scene::Scene& scene, double, const run::RunOptions&) {
    run::CaseResult result = sound_burn(scene);
    runs.at(scene.numerics.time_step_factor)->spoil_burn(result);
    return result;
  };
  return run_stability(study_of(head + group_of(cases)), options);
}

const StabilityResult& made_result() {
  static const StabilityResult result = compute_made();
  return result;
}

/// Every made case whose name begins so came to what it must.
void expect_as_made(const std::string& begin) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < made_cases().size(); ++i) {
    const Made& made = made_cases()[i];
    if (!made.name.starts_with(begin)) continue;
    const StressCaseRow& row = made_result().rows.at(i);
    SCOPED_TRACE(made.name);
    EXPECT_EQ(to_string(row.finding.outcome), to_string(made.outcome)) << row.finding.text << row.run.failure;
    EXPECT_NE(row.finding.text.find(made.part), std::string::npos) << row.finding.text;
    EXPECT_EQ(row.is_as_expected(), made.outcome != Outcome::wrong);
    ++seen;
  }
  EXPECT_GT(seen, 0u);
}

TEST(Stability, ASoundRunIsHeld) {
  expect_as_made("sound");
  EXPECT_TRUE(made_result().rows.front().run.violations.empty());
}
TEST(Stability, EveryBrokenInvariantUnderASafeVerdictIsWrong) { expect_as_made("broken: "); }
TEST(Stability, ATemperatureOffTheSafeComputationIsWrongUpToIgnition) { expect_as_made("compared: "); }
TEST(Stability, WhatSaysSoItselfIsDegradedAndWhatStopsIsCaught) { expect_as_made("flagged: "); }
TEST(Stability, ARunThroughIgnitionThatBreaksAnInvariantIsWrong) { expect_as_made("burning: "); }

StudyOptions options_with(std::function<MechanicsResult(const scene::Scene&)> mechanics) {
  StudyOptions options;
  options.jobs = 2;
  options.runners.mechanics = [mechanics = std::move(mechanics)](const scene::Scene& scene,
                                                                 const run::RunOptions&) {
    return mechanics(scene);
  };
  return options;
}

TEST(Stability, WhatIsNotExpectedNotComputedOrNotRefusedIsCounted) {
  const std::string refused = "refused = \"to 2\", set = { numerics.time_step_factor = ";
  const StabilityResult result = run_stability(
      study_of(
          head +
          group_of("{ name = \"unexpected\", expect = \"caught, degraded\" },\n"
                   "{ name = \"thrown\", set = { load.peak = \"400 MPa\" } },\n"
                   "{ name = \"too long\", " +
                   refused +
                   "3 } },\n"
                   "{ name = \"taken\", " +
                   refused +
                   "1 } },\n"
                   "{ name = \"for another\", refused = \"to 2\", set = { load.peak = \"11 GPa\" } },\n")),
      options_with([](const scene::Scene& scene) {
        if (scene.load.peak == 400e6) throw std::runtime_error("no more");
        return sound_mechanics(scene);
      }));
  ASSERT_EQ(result.rows.size(), 5u);
  EXPECT_EQ(result.rows[0].finding.outcome, Outcome::held);
  EXPECT_FALSE(result.rows[0].is_as_expected());
  EXPECT_EQ(result.rows[1].run.failure, "the run failed: no more");
  EXPECT_FALSE(result.rows[1].is(Outcome::wrong));
  EXPECT_TRUE(result.rows[2].is_as_expected()) << result.rows[2].finding.text;
  EXPECT_EQ(result.rows[2].finding.outcome, Outcome::caught);
  for (const std::size_t i : {3u, 4u}) EXPECT_TRUE(result.rows[i].is(Outcome::wrong)) << i;
  EXPECT_NE(result.rows[3].finding.text.find("the reader took the scene"), std::string::npos);
  EXPECT_NE(result.rows[4].finding.text.find("not for \"to 2\""), std::string::npos);
  EXPECT_EQ(result.count(Outcome::wrong), 2u);
  const StudyOutcome outcome =
      run_study(result.study, options_with([](const scene::Scene& scene) { return sound_mechanics(scene); }));
  EXPECT_EQ(outcome.failures.size(), 3u) << "a case that is WRONG or not as expected fails the study";
}

TEST(Stability, TheImpulseOfTheLoadIsTheMomentumInTheLabFrame) {
  const StudyFile study = study_of(head + group_of("{ name = \"lab\", set = { frame = \"lab\" } },\n"));
  const scene::Scene& scene = study.cases[0].scene.scene;
  // Simpson's rule on the load in closed form.
  const scene::PressureHistory load(scene.load);
  double impulse = 0;
  for (int i = 0; i < 1000; ++i) {
    const double begin = 18e-6 * i, end = 18e-6 * (i + 1);
    impulse += 18e-6 / 6.0 * (load.at(begin) + 4.0 * load.at(0.5 * (begin + end)) + load.at(end));
  }
  impulse *= scene::base_area(scene);
  MechanicsResult run = sound_mechanics(scene);
  run.monitor[1].momentum = -impulse;
  EXPECT_TRUE(violations_of({scene, run, {1e-4}}, {}).empty());
  run.monitor[1].momentum = -1.01 * impulse;
  EXPECT_EQ(violations_of({scene, run, {1e-4}}, {}).size(), 1u);
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
  EXPECT_EQ(forecast_study(study, options, 1e6).runs.size(), 5u);
  const StabilityResult result = run_stability(study, options);
  EXPECT_EQ(burns, 2);
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_EQ(result.rows[0].finding.outcome, Outcome::held) << result.rows[0].finding.text;
  const Finding& worst = result.rows[1].finding;
  EXPECT_EQ(worst.outcome, Outcome::wrong) << worst.text;
  EXPECT_TRUE(worst.text.starts_with("through ignition at 0.02 cm: burning particles made or lost"))
      << worst.text;
  EXPECT_NE(worst.text.find("through ignition at 0.01 cm: burnt 1 g"), std::string::npos) << worst.text;
}

TEST(Stability, CasesShareTheirSafeComputation) {
  const StudyFile study = study_of(
      head +
      "[[group]]\nname = \"made\"\nagainst = { numerics.time_step_factor = 0.1 }\n"
      "cases = [{ name = \"one\" }, { name = \"two\", set = { numerics.time_step_factor = 0.3 } }]\n");
  EXPECT_EQ(study.cases.size(), 4u);
  EXPECT_EQ(forecast_study(study, {}, 1e6).runs.size(), 3u);
}

}  // namespace
