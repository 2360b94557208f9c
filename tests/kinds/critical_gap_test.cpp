#include "launchsafe/kinds/critical_gap.hpp"

#include "../../src/run/runner.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/run_cases.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string gap_keys = "gaps = \"0, 0.01, 0.02, 0.03, 0.06 cm\"\n";

/// Silence about the mesh is no certainty: the same gaps as above, nothing stated.
TEST(CriticalGapStudy, WithoutAStatedUncertaintyASmallMarginIsNotSafe) {
  const auto result =
      run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), synthetic_options());
  for (const GapVerdict& row : result.details.front().verdicts)
    if (row.judgement.verdict == Verdict::safe) {
      EXPECT_GT(row.margin, assumed_numerical_uncertainty);
    }
  EXPECT_TRUE(result.any_indeterminate());
}

TEST(CriticalGapStudy, FindsTheGapAndConfirmsIt) {
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys +
                                "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n" +
                                synthetic_constants),
                       synthetic_options());
  ASSERT_EQ(result.details.size(), 1u);
  const CaseOutcome& outcome = result.details[0];
  ASSERT_EQ(outcome.critical.kind, CriticalGapKind::value) << text_of(outcome.critical.reason);
  EXPECT_LE(outcome.critical.upper - outcome.critical.lower, 1e-6);
  EXPECT_GT(outcome.critical.value, 3e-4);
  EXPECT_LT(outcome.critical.value, 6e-4);
  ASSERT_EQ(outcome.confirmations.size(), 2u);
  for (const Confirmation& each : outcome.confirmations) EXPECT_TRUE(each.agrees());
  EXPECT_EQ(outcome.confirmations[0].difference, 0.0);
  EXPECT_EQ(result.timing.runs, 3u);  // the launch and two confirmations
  ASSERT_EQ(outcome.verdicts.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(outcome.verdicts[i].judgement.verdict, Verdict::safe) << reason_text(outcome.verdicts[i]);
  EXPECT_EQ(outcome.verdicts[4].judgement.verdict, Verdict::unsafe);
  ASSERT_TRUE(outcome.verdicts[4].ignition.has_value());
  EXPECT_EQ(outcome.verdicts[4].ignition->point, "S2");
  EXPECT_EQ(outcome.verdicts[0].maximum.point, "S2");
  // The point G1, which is hotter, is read beside it.
  EXPECT_EQ(outcome.lines.size(), 2u);
  EXPECT_TRUE(outcome.completed());
  for (const Confirmation& each : outcome.confirmations) EXPECT_TRUE(each.completed);
  EXPECT_FALSE(result.any_indeterminate());
}

TEST(CriticalGapStudy, TheResultDoesNotDependOnTheNumberOfThreads) {
  const StudyFile study = study_of(critical_text + gap_keys + vary({{"peak_pressure", "410, 496, 450 MPa"}}) +
                                   synthetic_constants);
  const CriticalGapResult one = run_critical_gap(study, synthetic_options(1));
  const CriticalGapResult many = run_critical_gap(study, synthetic_options(4));
  ASSERT_EQ(one.details.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const CaseOutcome &a = one.details[i], &b = many.details[i];
    EXPECT_EQ(a.input.label, b.input.label);
    EXPECT_EQ(a.critical.lower, b.critical.lower);
    EXPECT_EQ(a.critical.upper, b.critical.upper);
    EXPECT_EQ(a.critical.bounds.at_least, b.critical.bounds.at_least);
    EXPECT_EQ(a.critical.bounds.at_most, b.critical.bounds.at_most);
    for (std::size_t gap = 0; gap < a.verdicts.size(); ++gap) {
      EXPECT_EQ(a.verdicts[gap].maximum.temperature, b.verdicts[gap].maximum.temperature);
      EXPECT_EQ(reason_text(a.verdicts[gap]), reason_text(b.verdicts[gap]));
    }
  }
  EXPECT_GT(one.details[0].critical.value, one.details[1].critical.value);  // less pressure, wider gap
}

TEST(CriticalGapStudy, AFailingCaseIsIndeterminateAndTheOthersGoOn) {
  for (const bool throws : {true, false}) {
    StudyOptions options = synthetic_options(2);
    options.runners.mechanics = [throws](const scene::Scene& scene, const run::RunOptions&) {
      run::MechanicsResult result = synthetic_mechanics(scene);
      if (scene.load.peak != 450e6) return result;
      if (throws) throw std::runtime_error("out of memory");
      result.status = run::RunStatus::energy_drift;
      result.reason = "at 3 ms";
      return result;
    };
    const CriticalGapResult result =
        run_critical_gap(study_of(critical_text + gap_keys + vary({{"peak_pressure", "400, 450, 496 MPa"}}) +
                                  synthetic_constants),
                         options);
    const CaseOutcome& broken = result.details[1];
    EXPECT_FALSE(broken.completed());
    EXPECT_EQ(broken.critical.kind, CriticalGapKind::indeterminate);
    EXPECT_TRUE(std::isnan(broken.critical.value));
    EXPECT_TRUE(broken.confirmations.empty());
    EXPECT_TRUE(broken.lines.empty());
    ASSERT_EQ(broken.verdicts.size(), 5u);
    for (const GapVerdict& row : broken.verdicts) {
      EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
      EXPECT_EQ(row.judgement.code, ReasonCode::failed);
    }
    for (const std::size_t i : {0u, 2u}) {
      EXPECT_EQ(result.details[i].critical.kind, CriticalGapKind::value);
      EXPECT_EQ(result.details[i].verdicts[0].judgement.verdict, Verdict::safe);
    }
  }
}

TEST(CriticalGapStudy, ARunWithSkinThatDisagreesMakesItIndeterminate) {
  StudyOptions options = synthetic_options();
  options.runners.with_skin = synthetic_runners(160.0).with_skin;
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), options);
  const CaseOutcome& outcome = result.details[0];
  EXPECT_EQ(outcome.critical.kind, CriticalGapKind::indeterminate);
  EXPECT_TRUE(std::isnan(outcome.critical.value));
  EXPECT_EQ(outcome.critical.reason.code, GapReasonCode::coupled_ignites);
  EXPECT_EQ(outcome.verdicts[0].judgement.verdict, Verdict::indeterminate);
  EXPECT_EQ(outcome.verdicts[4].judgement.verdict, Verdict::unsafe);
}

TEST(CriticalGapStudy, ARunWithSkinThatFailsMakesItIndeterminate) {
  for (const bool throws : {true, false}) {
    StudyOptions options = synthetic_options();
    options.runners.with_skin = [throws, agree = options.runners.with_skin](
                                    const scene::Scene& scene, double gap, const run::RunOptions& run) {
      if (throws) throw std::runtime_error("broken");
      run::CaseResult result = agree(scene, gap, run);
      result.mechanics.status = run::RunStatus::non_finite;
      return result;
    };
    const CriticalGapResult result =
        run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), options);
    EXPECT_EQ(result.details[0].critical.kind, CriticalGapKind::indeterminate);
    EXPECT_FALSE(result.details[0].confirmations[0].completed);
  }
}

TEST(CriticalGapStudy, ACoupledRunThatBurntConfirmsAnIgnitionUnlessItWasCutOff) {
  for (const run::RunStatus status : {run::RunStatus::outside_gas_law, run::RunStatus::timed_out}) {
    StudyOptions options = synthetic_options();
    options.runners.with_skin = [status, agree = options.runners.with_skin](
                                    const scene::Scene& scene, double gap, const run::RunOptions& run) {
      run::CaseResult result = agree(scene, gap, run);
      if (!result.gaps.front().skin.ignition) return result;
      result.mechanics.status = status;
      result.gaps.front().combustion.emplace();
      return result;
    };
    const CriticalGapResult result =
        run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), options);
    const bool by_itself = status == run::RunStatus::outside_gas_law;
    EXPECT_EQ(result.details[0].confirmations[1].completed, by_itself);
    EXPECT_EQ(result.details[0].critical.kind,
              by_itself ? CriticalGapKind::value : CriticalGapKind::indeterminate);
  }
}

TEST(CriticalGapStudy, BoundsAreNotConfirmedAndNotNumbers) {
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(1.0);
  const std::string text = critical_text +
                           "gaps = \"0, 0.001 cm\"\nlargest_gap = \"0.002 cm\"\n"
                           "accept = [{ key = \"largest_gap\", value = \"0.002 cm\", because = \"the search "
                           "is to end without a gap\" }]\n";
  const CriticalGapResult cold = run_critical_gap(study_of(text + synthetic_constants), options);
  EXPECT_EQ(cold.details[0].critical.kind, CriticalGapKind::all_safe);
  EXPECT_TRUE(cold.details[0].confirmations.empty());
  EXPECT_EQ(cold.details[0].verdicts[1].judgement.verdict, Verdict::indeterminate) << "of an early end";
  options.runners = synthetic_runners(400.0);
  const CriticalGapResult hot = run_critical_gap(study_of(text + synthetic_constants), options);
  EXPECT_EQ(hot.details[0].critical.kind, CriticalGapKind::all_ignite);
  EXPECT_EQ(hot.details[0].verdicts[0].judgement.verdict, Verdict::unsafe);
}

TEST(CriticalGapStudy, TheStatedMeshUncertaintyCanMakeAGapIndeterminate) {
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys +
                                "numerical_uncertainty = { value = \"60 K\", because = \"for a test\" }\n" +
                                synthetic_constants),
                       synthetic_options());
  const auto& rows = result.details[0].verdicts;
  EXPECT_EQ(rows[0].judgement.verdict, Verdict::safe) << reason_text(rows[0]);
  EXPECT_EQ(rows[3].judgement.verdict, Verdict::indeterminate) << reason_text(rows[3]);
}

TEST(CriticalGapStudy, AnEmptyOrBrokenTraceIsIndeterminate) {
  for (const bool empty : {true, false}) {
    StudyOptions options = synthetic_options();
    options.runners.mechanics = [empty](const scene::Scene& scene, const run::RunOptions&) {
      run::MechanicsResult result = synthetic_mechanics(scene);
      if (empty) result.trace = {};
      if (!empty) result.trace.mean_bottom_pressure[100] = std::nan("");
      return result;
    };
    const CriticalGapResult result =
        run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), options);
    EXPECT_EQ(result.details[0].critical.kind, CriticalGapKind::indeterminate);
    for (const GapVerdict& row : result.details[0].verdicts) {
      if (row.gap > 0 || empty) {
        EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate) << row.gap;
      }
    }
  }
}

TEST(CriticalGapStudy, StoppedBeforeItBeganNothingIsSafe) {
  std::atomic<bool> stop{true};
  StudyOptions options = synthetic_options();
  options.stop = &stop;
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.timing.runs, 0u);
  for (const GapVerdict& row : result.details[0].verdicts)
    EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
}

TEST(CriticalGapStudy, ComparesWithPublishedRows) {
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys +
                                "reference = [{ gap = \"0.01 cm\", maximum_temperature = \"442.2 K\", "
                                "early_temperature = \"339.1 K\" }]\n" +
                                synthetic_constants),
                       synthetic_options());
  const auto& rows = result.details[0].verdicts;
  EXPECT_TRUE(std::isnan(rows[0].misfit()));
  EXPECT_NEAR(rows[1].misfit(), rows[1].maximum.temperature - 442.2, 1e-12);
  EXPECT_NEAR(rows[1].early_misfit(), rows[1].early.temperature - 339.1, 1e-12);
}

}  // namespace
