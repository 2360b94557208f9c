// Values that no launch has: their verdicts have a validity warning, unless scene or study says why they are
// meant.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// An uncertainty that a study states by hand.
std::string stated(const std::string& key, const std::string& value) {
  return fmt::format("{} = {{ value = \"{}\", because = \"for a test\" }}\n", key, value);
}

/// A study that finds the gap 0 safe; more top-level keys before, more overrides after.
std::string safe_study(const std::string& keys, const std::string& overrides = "") {
  std::string text = keys + critical_kind + "gaps = \"0 cm\"\nconfirm = false\n";
  for (const std::string key : {"numerical_uncertainty", "fit_uncertainty", "input_uncertainty"}) {
    if (keys.find(key) == std::string::npos) text += stated(key, "1 K");
  }
  return text + synthetic_constants + overrides;
}

/// A verdict and its words.
struct Told {
  Verdict verdict;
  std::string reason;
};

Told judgement_in(const CriticalGapResult& result) {
  const GapVerdict& row = result.details.at(0).verdicts.at(0);
  return {row.judgement.verdict, reason_text(row)};
}

CriticalGapResult run_safe_study(const std::string& keys, const std::string& overrides = "") {
  return run_critical_gap(study_of(safe_study(keys, overrides)), synthetic_options());
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string entry(const std::string& key, const std::string& value, const std::string& because) {
  return fmt::format("{{ key = \"{}\", value = \"{}\", because = \"{}\" }}", key, value, because);
}

std::string accept(const std::string& key, const std::string& value, const std::string& because) {
  return "accept = [" + entry(key, value, because) + "]\n";
}

/// What of a case is to be accepted, accepted for a reason.
std::string accept_all(const StudyFile& study, const std::string& because) {
  std::string entries;
  for (const scene::Implausible& each : statements_of(study.study, study.cases.front()).to_be_accepted())
    entries += entry(each.key, each.value, because) + ", ";
  return "accept = [" + entries + "]\n";
}

TEST(StudyPlausibility, AnImplausibleValueIsIndeterminateUntilItIsAccepted) {
  EXPECT_EQ(judgement_in(run_safe_study("")).verdict, Verdict::safe);
  // A key, and how it is overridden.
  const std::vector<std::array<std::string, 2>> edits{
      {"gap.skin_thickness", "gap.skin_thickness = \"1 cm\"\n"},
      {"gap.air_pressure", "gap.air_pressure = \"130 kPa\"\n"},
      {"charge.sliding_friction", "charge.sliding_friction = 0\n"},
      {"charge.toughness", "charge.toughness = \"5e7 Pa m^0.5\"\n"},
      {"numerics.energy_drift_limit", "numerics.energy_drift_limit = 100\n"},
      {"body.wall.r", "body.wall.r = \"6.5 to 6.53 cm\"\nnumerics.cell_size = \"0.5 mm\"\n"},
  };
  for (const auto& [key, overrides] : edits) {
    const CriticalGapResult warned = run_safe_study("", overrides);
    EXPECT_EQ(judgement_in(warned).verdict, Verdict::indeterminate) << key;
    EXPECT_TRUE(says(judgement_in(warned).reason, key + " = ")) << judgement_in(warned).reason;
    EXPECT_EQ(warned.details[0].critical.kind, CriticalGapKind::indeterminate) << key;
    const std::string reasons = accept_all(study_of(safe_study("", overrides)), "it was measured so");
    const Told accepted = judgement_in(run_safe_study(reasons, overrides));
    EXPECT_TRUE(says(accepted.reason, "accepted: " + key)) << accepted.reason;
    EXPECT_TRUE(says(accepted.reason, "it was measured so")) << accepted.reason;
  }
}

TEST(StudyPlausibility, AStatedUncertaintyMustBePlausibleToo) {
  for (const std::string key : {"numerical_uncertainty", "fit_uncertainty", "input_uncertainty"}) {
    for (const std::string value : {"0 K", "0.01 K"}) {
      const std::string statement = stated(key, value),
                        accepted = accept(key + ".value", value, "a test of the search");
      EXPECT_EQ(judgement_in(run_safe_study(statement)).verdict, Verdict::indeterminate) << key;
      EXPECT_EQ(judgement_in(run_safe_study(statement + accepted)).verdict, Verdict::safe) << key;
    }
    EXPECT_FALSE(parse_here(safe_study(stated(key, "1e300 K")))) << key;
  }
}

TEST(StudyPlausibility, EveryCaseOfASweepIsJudgedOnItsOwnValues) {
  const std::string text =
      critical_text + "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n" +
      "gaps = \"0 cm\"\n" + vary({{"gap.skin_thickness", "0.1, 5 mm"}}) + synthetic_constants;
  const CriticalGapResult result = run_critical_gap(lean_study_of(text), synthetic_options());
  ASSERT_EQ(result.answers.size(), 2u);
  EXPECT_EQ(result.answers[0].verdicts[0].judgement.verdict, Verdict::safe);
  EXPECT_EQ(result.answers[1].verdicts[0].judgement.verdict, Verdict::indeterminate);
}

TEST(StudyPlausibility, WhatAStudySetsHasToGiveTheExpectedVelocityToo) {
  const std::string expected = "load.expected_velocity = \"760 m/s\"\n";
  EXPECT_TRUE(parse_here(safe_study("", expected)));
  const auto mistaken = parse_here(safe_study("", expected + "load.peak = \"248 MPa\"\n"));
  ASSERT_FALSE(mistaken);
  EXPECT_TRUE(mistaken.error().key.ends_with("load.expected_velocity")) << mistaken.error().message();
  EXPECT_TRUE(parse_here(vary({{"peak_pressure", "248, 496 MPa"}}) + safe_study("", expected)))
      << "other launches on purpose";
}

// Its stress cases ask what the computation makes of them; none may pass because its input is called
// implausible.
TEST(StudyPlausibility, AStabilityStudyJudgesWithoutIt) {
  StudyFile study = study_of(safe_study("", "gap.skin_thickness = \"5 mm\"\n"));
  study.study.largest_gap = widest_search;
  const run::MechanicsResult mechanics = synthetic_mechanics(study.cases[0].scene.scene);
  EXPECT_EQ(answer_of(study.study, study.cases[0], mechanics).verdicts[0].judgement.verdict,
            Verdict::indeterminate);
  study.study.kind = kinds::traits_of("stability");
  EXPECT_EQ(answer_of(study.study, study.cases[0], mechanics).verdicts[0].judgement.verdict, Verdict::safe);
}

TEST(StudyPlausibility, EveryCaseOfTheShippedStudiesIsPlausible) {
  // Studies of accuracy vary numerics beyond what a verdict may rest on.
  for (const char* name : {"critical_gap_155mm", "critical_gap_105mm", "critical_gap_203mm",
                           "sweep_pressure_defect", "sweep_smoke", "sensitivity", "calibrate_table8"}) {
    const auto study = read_study(studies_folder / (std::string(name) + ".toml"));
    ASSERT_TRUE(study) << study.error().message();
    EXPECT_TRUE(study->study.implausible.empty()) << name;
    for (const StudyCase& each : study->cases) {
      for (const scene::Implausible& value : scene::implausible_values(each.scene.scene))
        ADD_FAILURE() << name << ", " << each.label << ": " << scene::validity_warning(value);
    }
  }
}

// On a bottom that stays within 2 K of its first temperature nothing but the calibration keeps a gap from
// SAFE.
TEST(StudyPlausibility, TheShellThatNobodyTakesTheConstantsOverForIsNeverSafe) {
  std::ifstream file(studies_folder / "critical_gap_203mm.toml");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string whole =
      "[set]\nload.muzzle_exit = \"16 ms\"\noutput.snapshots = \"9 ms\"\n";  // as the synthetic launch
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(2.0);
  const CriticalGapResult shipped = run_critical_gap(study_of(text + whole), options);
  ASSERT_FALSE(shipped.details.at(0).verdicts.empty());
  for (const GapVerdict& each : shipped.details[0].verdicts)
    EXPECT_EQ(each.judgement.verdict, each.ignition ? Verdict::unsafe : Verdict::indeterminate);
  const std::string taken_over = accept_all(study_of(text + whole), "for this test") + text + whole;
  const Told judgement = judgement_in(run_critical_gap(study_of(taken_over), options));
  EXPECT_EQ(judgement.verdict, Verdict::safe) << judgement.reason;
}

}  // namespace
