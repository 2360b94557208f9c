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

TEST(CriticalGapStudy, FindsTheGapAndConfirmsIt) {
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), synthetic_options());
  ASSERT_EQ(result.details.size(), 1u);
  const CaseInDetail& found = result.details[0];
  ASSERT_EQ(found.critical.kind, CriticalGapKind::value) << found.failure;
  EXPECT_GT(found.critical.value, 3e-4);
  EXPECT_LT(found.critical.value, 6e-4);
  ASSERT_EQ(found.confirmations.size(), 2u);
  for (const Confirmation& each : found.confirmations) EXPECT_TRUE(each.agrees());
  EXPECT_DOUBLE_EQ(found.confirmations[0].gap, found.critical.value - confirm_distance);
  EXPECT_DOUBLE_EQ(found.confirmations[1].gap, found.critical.value + confirm_distance);
  EXPECT_EQ(result.timing.runs, 3u);  // the launch and two confirmations
  ASSERT_EQ(found.gaps.size(), 5u);
  EXPECT_EQ(found.gaps[0].judgement.verdict, Verdict::safe) << reason_text(found, found.gaps[0]);
  EXPECT_EQ(found.gaps[4].judgement.verdict, Verdict::unsafe);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(found.gaps[i].judgement.verdict,
              found.gaps[i].gap < found.bounds.at_least ? Verdict::safe : Verdict::indeterminate)
        << reason_text(found, found.gaps[i]);
  ASSERT_TRUE(found.gaps[4].ignition.has_value());
  EXPECT_EQ(found.gaps[4].ignition->point, "S2");
  EXPECT_EQ(found.gaps[0].maximum.point, "S2");
  // The point G1, which is hotter, is read beside it.
  EXPECT_EQ(found.lines.size(), 2u);
}

TEST(CriticalGapStudy, StatedNumericsLowerTheBound) {
  const auto bound_with = [](const std::string& numerics) {
    const std::string text = critical_kind + "uncertainty.peak_pressure = \"0 %\"\nnumerics = { value = \"" +
                             numerics + "\", because = \"for a test\" }\n" + gap_keys + synthetic_constants;
    return run_critical_gap(study_of(text), synthetic_options()).rows[0].bounds.at_least;
  };
  EXPECT_LT(bound_with("10 K"), bound_with("1 K"));
}

TEST(CriticalGapStudy, TheResultDoesNotDependOnTheNumberOfThreads) {
  const StudyFile study = study_of(critical_text + gap_keys + vary({{"peak_pressure", "410, 496, 450 MPa"}}) +
                                   synthetic_constants);
  const CriticalGapResult one = run_critical_gap(study, synthetic_options(1));
  const CriticalGapResult many = run_critical_gap(study, synthetic_options(4));
  ASSERT_EQ(one.details.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const CaseInDetail &a = one.details[i], &b = many.details[i];
    EXPECT_EQ(a.input.label, b.input.label);
    EXPECT_EQ(a.critical.value, b.critical.value);
    EXPECT_EQ(a.bounds.at_least, b.bounds.at_least);
    EXPECT_EQ(a.bounds.at_most, b.bounds.at_most);
    for (std::size_t gap = 0; gap < a.gaps.size(); ++gap) {
      EXPECT_EQ(a.gaps[gap].maximum.temperature, b.gaps[gap].maximum.temperature);
      EXPECT_EQ(reason_text(a, a.gaps[gap]), reason_text(b, b.gaps[gap]));
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
    const CaseInDetail& broken = result.details[1];
    EXPECT_FALSE(broken.completed());
    EXPECT_EQ(broken.critical.kind, CriticalGapKind::unknown);
    EXPECT_TRUE(std::isnan(broken.critical.value));
    EXPECT_TRUE(broken.confirmations.empty());
    EXPECT_TRUE(broken.lines.empty());
    ASSERT_EQ(broken.gaps.size(), 5u);
    for (const GapRow& row : broken.gaps) {
      EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
      EXPECT_EQ(row.judgement.code, ReasonCode::failed);
    }
    for (const std::size_t i : {0u, 2u}) {
      EXPECT_EQ(result.details[i].critical.kind, CriticalGapKind::value);
      EXPECT_EQ(result.details[i].gaps[0].judgement.verdict, Verdict::safe);
    }
  }
}

TEST(CriticalGapStudy, ARunWithSkinThatDisagreesLeavesItWithoutBounds) {
  StudyOptions options = synthetic_options();
  options.runners.with_skin = synthetic_runners(160.0).with_skin;
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys + synthetic_constants), options);
  const CaseRow& row = result.rows[0];
  EXPECT_EQ(row.critical.kind, CriticalGapKind::value);
  EXPECT_FALSE(row.incomplete.empty());
  EXPECT_TRUE(std::isnan(row.bounds.at_least));
  for (const GapRow& gap : row.gaps) EXPECT_EQ(gap.judgement.code, ReasonCode::failed);
}

TEST(CriticalGapStudy, ARunWithSkinThatFailsLeavesItWithoutBounds) {
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
    EXPECT_TRUE(std::isnan(result.rows[0].bounds.at_least));
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
    EXPECT_EQ(std::isfinite(result.rows[0].bounds.at_least), by_itself);
  }
}

// Without ignition up to 0.02 cm the lower bound is half of that.
TEST(CriticalGapStudy, SearchesWithoutAChangeAreNotConfirmed) {
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(1.0);
  const std::string text = critical_text + "gaps = \"0, 0.015 cm\"\nlargest_gap = \"0.02 cm\"\n";
  const CriticalGapResult cold = run_critical_gap(study_of(text + synthetic_constants), options);
  EXPECT_EQ(cold.details[0].critical.kind, CriticalGapKind::all_safe);
  EXPECT_TRUE(cold.details[0].confirmations.empty());
  EXPECT_EQ(cold.details[0].gaps[0].judgement.verdict, Verdict::safe);
  EXPECT_EQ(cold.details[0].gaps[1].judgement.code, ReasonCode::within_bounds);
  options.runners = synthetic_runners(400.0);
  const CriticalGapResult hot = run_critical_gap(study_of(text + synthetic_constants), options);
  EXPECT_EQ(hot.details[0].critical.kind, CriticalGapKind::all_ignite);
  EXPECT_TRUE(hot.details[0].confirmations.empty());
  EXPECT_EQ(hot.details[0].gaps[0].judgement.verdict, Verdict::unsafe);
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
    EXPECT_EQ(result.details[0].critical.kind, CriticalGapKind::unknown);
    for (const GapRow& row : result.details[0].gaps)
      EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate) << row.gap;
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
  for (const GapRow& row : result.details[0].gaps) EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
}

TEST(CriticalGapStudy, ComparesWithPublishedRows) {
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_text + gap_keys +
                                "reference = [{ gap = \"0.01 cm\", maximum_temperature = \"442.2 K\", "
                                "early_temperature = \"339.1 K\" }]\n" +
                                synthetic_constants),
                       synthetic_options());
  const auto& rows = result.details[0].gaps;
  EXPECT_TRUE(std::isnan(rows[0].misfit()));
  EXPECT_NEAR(rows[1].misfit(), rows[1].maximum.temperature - 442.2, 1e-12);
  EXPECT_NEAR(rows[1].early_misfit(), rows[1].early.temperature - 339.1, 1e-12);
}

}  // namespace
