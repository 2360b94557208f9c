// Rows of cases drawn from their finished launches, on a launch in closed form.
#include "launchsafe/study/case_rows.hpp"

#include "study/synthetic_launch.hpp"

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

StudyFile six_gaps(const std::string& keys = {}) {
  return study_of(critical_text + "gaps = \"0, 0.01, 0.02, 0.03, 0.04, 0.05 cm\"\n" + keys);
}

FinishedRun finished(Part part, const StudyCase& input, double kelvin = 116.1) {
  FinishedRun run;
  run.outcome = RunOutcome::ran;
  run.result.mechanics = synthetic_mechanics(input.scene.scene, kelvin);
  run.part = part;
  return run;
}

CaseInDetail drawn(const StudyFile& study) {
  const StudyCase input = study.cases.front();
  return draw_case(study.study, input, {finished(Part::own, input)});
}

std::vector<std::string> verdicts_of(const CaseRow& row) {
  return of_each(row.gaps, [](const GapRow& gap) { return to_string(gap.judgement.verdict); });
}

/// The bounds lie around the critical gap, and every gap is judged by them.
TEST(CaseRows, AreJudgedByTheBoundsOfTheCriticalGap) {
  const CaseInDetail row = drawn(six_gaps());
  ASSERT_EQ(row.critical.kind, CriticalGapKind::value);
  EXPECT_GT(row.bounds.at_least, 0.0);
  EXPECT_LT(row.bounds.at_least, row.critical.value);
  EXPECT_GT(row.bounds.at_most, row.critical.value);
  EXPECT_EQ(row.basis(), "calibrated") << names_text(row.extrapolated);
  EXPECT_TRUE(row.warnings.empty()) << names_text(row.warnings);
  for (const GapRow& gap : row.gaps) {
    const bool ignites = gap.gap >= row.critical.value;
    EXPECT_EQ(gap.ignition.has_value(), ignites) << gap.gap;
    EXPECT_EQ(gap.judgement.verdict, ignites                         ? Verdict::unsafe
                                     : gap.gap < row.bounds.at_least ? Verdict::safe
                                                                     : Verdict::indeterminate);
    // A gap that runs away after the launch is not below the bound.
    if (gap.ignition_after_launch) {
      EXPECT_GE(gap.gap, row.bounds.at_least);
    }
    EXPECT_GT(gap.uncertainty, 0.0);
  }
  EXPECT_EQ(row.gaps.front().judgement.verdict, Verdict::safe);
  EXPECT_EQ(row.gaps.back().judgement.verdict, Verdict::unsafe);
}

TEST(CaseRows, AreTheSameInAStudyOfManyCases) {
  const StudyFile study = six_gaps();
  const CaseInDetail one = drawn(study);
  const CaseRow many = rows_of(study).front();
  EXPECT_EQ(many.critical.value, one.critical.value);
  EXPECT_EQ(many.bounds.at_least, one.bounds.at_least);
  EXPECT_EQ(many.bounds.at_most, one.bounds.at_most);
  EXPECT_EQ(verdicts_of(many), verdicts_of(one));
  for (std::size_t i = 0; i < one.gaps.size(); ++i)
    EXPECT_EQ(many.gaps[i].maximum.temperature, one.gaps[i].maximum.temperature) << i;
}

// Below ignition the reaction adds less than a kelvin (at 508 K (Q Z/c) exp(-21700/508) is 2 K/ms); above it
// T max is that of the burning skin, while the heated temperature goes on as a smooth function of the gap.
TEST(CaseRows, HeatedTemperatureIsTMaxWithoutIgnition) {
  const CaseInDetail row = drawn(six_gaps());
  double last = 0, step = 0;
  for (std::size_t i = 0; i < row.gaps.size(); ++i) {
    const GapRow& gap = row.gaps[i];
    if (!gap.ignition) {
      EXPECT_NEAR(gap.heated, gap.maximum.temperature, 1.0) << i;
      EXPECT_LE(gap.heated, gap.maximum.temperature + 1e-6) << i;
    }
    if (i > 1) {
      EXPECT_NEAR(gap.heated - last, step, 0.1 * step) << i;
    }
    step = gap.heated - last;
    last = gap.heated;
  }
}

/// At the critical gap the uncertainty (K) is the rise of T max over what the bound leaves below it.
TEST(CaseRows, UncertaintyIsTheSlopeOverTheBounds) {
  const CaseInDetail row = drawn(six_gaps());
  const GapRow& gap = row.gaps[1];
  const double slope = (row.gaps[2].heated - gap.heated) / (row.gaps[2].gap - gap.gap);
  const double length = row.critical.value - row.bounds.at_least;
  EXPECT_NEAR(gap.uncertainty, slope * length, 0.1 * slope * length);
}

/// The launch of the case is sound, but nothing says how small its critical gap may be.
TEST(CaseRows, ALaunchBesideThatFailsLeavesNoBoundsAndNamesItself) {
  const StudyFile study = study_of(critical_kind + "gaps = \"0, 0.01 cm\"\n");
  const StudyCase input = study.cases.front();
  std::vector<FinishedRun> runs{finished(Part::own, input), finished(Part::raised, input, 120.0),
                                finished(Part::companion, input, 115.5)};
  const CaseInDetail sound = draw_case(study.study, input, runs);
  EXPECT_GT(sound.bounds.at_least, 0.0);
  EXPECT_EQ(sound.gaps.front().judgement.code, ReasonCode::below_bound);
  runs[2].failure = "energy drift";
  const CaseInDetail row = draw_case(study.study, input, runs);
  EXPECT_TRUE(row.completed());
  EXPECT_EQ(row.critical.value, sound.critical.value);
  EXPECT_TRUE(std::isnan(row.bounds.at_least) && std::isnan(row.bounds.at_most));
  for (const GapRow& gap : row.gaps) {
    EXPECT_EQ(gap.judgement.code, ReasonCode::failed);
    EXPECT_GT(gap.maximum.temperature, 400.0);
    EXPECT_NE(reason_text(row, gap).find("companion"), std::string::npos) << reason_text(row, gap);
  }
  // One that threw has no result.
  runs[2].outcome = RunOutcome::failed;
  runs[2].result = {};
  EXPECT_EQ(draw_case(study.study, input, runs).critical.value, sound.critical.value);
}

TEST(CaseRows, AFailedLaunchHasGapsWithoutNumbers) {
  const StudyFile study = six_gaps();
  FinishedRun run;
  run.failure = "out of memory";
  const CaseRow row = draw_row(study.study, study.cases.front(), {run});
  EXPECT_EQ(row.failure, "out of memory");
  EXPECT_EQ(row.critical.kind, CriticalGapKind::unknown);
  ASSERT_EQ(row.gaps.size(), 6u);
  for (const GapRow& gap : row.gaps) {
    EXPECT_EQ(gap.judgement.code, ReasonCode::failed);
    EXPECT_TRUE(std::isnan(gap.maximum.temperature) && std::isnan(gap.heated));
  }
}

/// A study accepts intervals by name, each for itself; of the explosive none.
TEST(CaseRows, ExtrapolationIsAcceptedByNameButOfTheExplosive) {
  StudyFile study = six_gaps(
      "accept.extrapolation.peak_pressure = \"a proof charge\"\n[set]\nload.peak = \"560 "
      "MPa\"\nload.expected_velocity = \"860 m/s\"\n");
  StudyCase input = study.cases.front();
  const auto row_of = [&] { return draw_case(study.study, input, {finished(Part::own, input, 100.0)}); };
  CaseRow row = row_of();
  EXPECT_EQ(names_text(row.extrapolated), "peak_pressure");
  EXPECT_EQ(row.basis(), "extrapolated");
  EXPECT_EQ(row.gaps.front().judgement.code, ReasonCode::below_bound) << reason_text(row, row.gaps.front());
  EXPECT_NE(accepted_text(row).find("a proof charge"), std::string::npos);
  const GapBounds bounds = row.bounds;
  study.study.accepted_extrapolation = {{"explosive", "much like the other one"},
                                        {"calibre", "no matter here"}};
  row = row_of();
  EXPECT_EQ(row.gaps.front().judgement.code, ReasonCode::extrapolated);
  EXPECT_EQ(row.bounds.at_least, bounds.at_least);
  study.study.accepted_extrapolation["peak_pressure"] = "a proof charge";
  EXPECT_EQ(row_of().gaps.front().judgement.code, ReasonCode::below_bound);
  input.scene.scene.charge().tension_cutoff *= 1.1;
  EXPECT_EQ(names_text(row_of().extrapolated), "peak_pressure, explosive");
  EXPECT_EQ(row_of().gaps.front().judgement.code, ReasonCode::extrapolated);
  input.scene.constants = nullptr;
  EXPECT_EQ(names_text(row_of().extrapolated), "constants");
}

/// A muzzle exit at 12.5 ms is within ten calibres of travel.
TEST(CaseRows, WarningsAreAcceptedByNameButOfTheFirstClass) {
  StudyFile study = six_gaps();
  StudyCase input = study.cases.front();
  input.scene.scene.load.muzzle_exit = 12.5e-3;
  FinishedRun run = finished(Part::own, input);
  const auto row_of = [&] { return draw_case(study.study, input, {run}); };
  CaseRow row = row_of();
  EXPECT_NE(names_text(row.warnings).find("short-travel"), std::string::npos) << names_text(row.warnings);
  EXPECT_EQ(row.gaps.front().judgement.code, ReasonCode::warning);
  for (const Remark& each : row.warnings) {
    EXPECT_TRUE(each.acceptable) << each.name << each.text;
    study.study.accepted_warnings[each.name] = "a barrel of a metre";
  }
  row = row_of();
  EXPECT_EQ(row.gaps.front().judgement.code, ReasonCode::below_bound) << reason_text(row, row.gaps.front());
  study.study.accepted_warnings["energy"] = "it will be fine";
  run.result.mechanics.monitor.clear();
  EXPECT_EQ(row_of().gaps.front().judgement.code, ReasonCode::warning);
}

/// A coupled run that does not do what the critical gap says of its gap.
TEST(CaseRows, AConfirmationThatDisagreesLeavesNoBounds) {
  CaseInDetail row = drawn(six_gaps());
  const Confirmation agrees{.gap = 1e-4, .ran = true, .completed = true};
  row.confirmations = {agrees, {.gap = 5e-4, .expected_ignition = true}};  // the second did not run
  apply_confirmations(row);
  EXPECT_EQ(row.gaps.front().judgement.code, ReasonCode::below_bound);
  for (const Confirmation& other :
       {Confirmation{.gap = 1e-4, .ran = true, .completed = true, .ignited = true},
        Confirmation{.gap = 5e-4, .expected_ignition = true, .ran = true, .completed = true},
        Confirmation{.gap = 1e-4, .ran = true, .failure = "energy drift"}}) {
    CaseInDetail contradicted = row;
    contradicted.confirmations.push_back(other);
    apply_confirmations(contradicted);
    EXPECT_EQ(contradicted.gaps.front().judgement.code, ReasonCode::failed);
    EXPECT_EQ(contradicted.critical.value, row.critical.value);
    EXPECT_FALSE(contradicted.incomplete.empty());
  }
}

}  // namespace
