// Sweeps: one run for cases of one mechanics, bounds, failures, and what is stored.
#include "made_sweeps.hpp"

namespace launchsafe::study {
namespace {

using namespace kinds;

TEST(Sweep, CasesThatDifferInThermalKeysShareOneMechanicalRun) {
  const StudyFile study = two_by_two_by_two_of();
  ASSERT_EQ(study.cases.size(), 8u);
  Counting counting;
  const CriticalGapResult result = run_critical_gap(study, counting.options());
  EXPECT_EQ(counting.runs(), 4);
  EXPECT_EQ(result.timing.runs, 4u);
  EXPECT_FALSE(any_failed(result.rows));
  // The last axis is the fastest: neighbours differ in the activation temperature alone.
  for (std::size_t i = 0; i < 8; i += 2)
    EXPECT_GT(result.rows[i + 1].critical.value, result.rows[i].critical.value) << i;
}

TEST(Sweep, IsTheSameWithAnyNumberOfJobs) {
  const StudyFile study = two_by_two_by_two_of();
  Counting counting;
  EXPECT_EQ(lines_of(run_critical_gap(study, counting.options(1))),
            lines_of(run_critical_gap(study, counting.options(4))));
}

// 1 K, 200 K and 400 K of friction: ignition at no gap up to the end of the search, at some, and at all.
TEST(Sweep, SearchesWithoutAChangeGiveBounds) {
  const StudyFile study = sweep_of("0, 0.01 cm", {{"peak_pressure", "400, 450, 496 MPa"}}, "0.02 cm");
  Counting counting;
  counting.outcome = [](const scene::Scene& scene) {
    const double peak = scene.load.peak;
    return synthetic_mechanics(scene, peak < 425e6 ? 1.0 : peak < 475e6 ? 200.0 : 400.0);
  };
  const CriticalGapResult result = run_critical_gap(study, counting.options());
  EXPECT_EQ(result.rows[0].critical.kind, CriticalGapKind::all_safe);
  EXPECT_EQ(result.rows[1].critical.kind, CriticalGapKind::value);
  EXPECT_EQ(result.rows[2].critical.kind, CriticalGapKind::all_ignite);
  EXPECT_EQ(result.rows[0].bounds.at_most, no_ignition);
  EXPECT_EQ(result.rows[0].critical.value, 2e-4);
  EXPECT_EQ(result.rows[2].bounds.at_least, 0.0);
}

TEST_F(StoredSweep, ComputesNothingASecondTime) {
  const StudyFile study = two_by_two_by_two_of();
  Counting first, second;
  const auto fresh = lines_of(run(study, first));
  const CriticalGapResult again = run(study, second);
  EXPECT_EQ(first.runs(), 4);
  EXPECT_EQ(second.runs(), 0);
  EXPECT_EQ(again.timing.runs, 0u);
  EXPECT_EQ(again.timing.reused, 4u);
  EXPECT_EQ(lines_of(again), fresh);
  EXPECT_EQ(case_files().size(), 4u);
}

TEST_F(StoredSweep, JudgesNewThermalValuesOnStoredRuns) {
  Counting first, second;
  run(two_by_two_by_two_of(), first);
  const StudyFile other = two_by_two_by_two_of("21200, 21700 K");
  const CriticalGapResult result = run(other, second);
  EXPECT_EQ(second.runs(), 0);
  Counting unstored;
  EXPECT_EQ(lines_of(result), lines_of(run_critical_gap(other, unstored.options())));
}

TEST_F(StoredSweep, WhereNothingMayBeComputedOnlyWhatIsStoredCounts) {
  const StudyFile study = sweep_of("0 cm", {{"peak_pressure", "400, 496, 550 MPa"}});
  Counting first, second;
  first.outcome = [](const scene::Scene& scene) {
    if (scene.load.peak == 400e6) throw std::bad_alloc();
    return synthetic_mechanics(scene);
  };
  run(sweep_of("0 cm", {{"peak_pressure", "400, 496 MPa"}}), first);
  const auto store = store::CaseStore::open(folder() / "results");
  StudyOptions options = second.options();
  options.store = store.get();
  options.compute = false;
  const CriticalGapResult result = run_critical_gap(study, options);
  EXPECT_EQ(second.runs(), 0);
  EXPECT_EQ(result.rows[0].failure, "the run failed: std::bad_alloc");  // as it would say by itself
  EXPECT_TRUE(result.rows[1].completed());
  EXPECT_EQ(result.rows[2].outcome, RunOutcome::not_stored);
  EXPECT_FALSE(store->flush());
  // Nothing was journaled that did not happen.
  EXPECT_EQ(store->records().size(), 2u);
}

TEST_F(StoredSweep, ComputesADamagedCaseAgain) {
  const StudyFile study = two_by_two_by_two_of();
  Counting first, second;
  const auto fresh = lines_of(run(study, first));
  const auto damaged = case_files().front();
  std::filesystem::resize_file(damaged, std::filesystem::file_size(damaged) / 2);
  const CriticalGapResult again = run(study, second);
  EXPECT_EQ(second.runs(), 1);
  EXPECT_EQ(lines_of(again), fresh);
  ASSERT_FALSE(remarks_.empty());
  EXPECT_NE(remarks_.front().find(damaged.stem().string()), std::string::npos) << remarks_.front();
}

TEST_F(StoredSweep, KeepsARunThatDriftedButTriesOneThatThrewAgain) {
  const StudyFile study = sweep_of("0 cm", {{"peak_pressure", "400, 496 MPa"}});
  Counting first, second;
  first.outcome = [](const scene::Scene& scene) {
    if (scene.load.peak == 400e6) throw std::bad_alloc();
    run::MechanicsResult result = synthetic_mechanics(scene);
    result.status = run::RunStatus::energy_drift;
    return result;
  };
  run(study, first);
  const CriticalGapResult again = run(study, second);
  EXPECT_EQ(second.runs_at(400e6), 1);
  EXPECT_EQ(second.runs_at(496e6), 0);
  EXPECT_TRUE(again.rows[0].completed());
  EXPECT_FALSE(again.rows[1].completed());
}

TEST_F(StoredSweep, TriesATimedOutCaseAgainOnlyUnderALongerLimit) {
  const StudyFile study = sweep_of("0 cm", {{"peak_pressure", "400, 496 MPa"}});
  const auto slow = [](const scene::Scene& scene) {
    run::MechanicsResult result = synthetic_mechanics(scene);
    if (scene.load.peak == 496e6) {
      result.status = run::RunStatus::timed_out;
      result.reason = "not done after 5 s";
    }
    return result;
  };
  Counting first, same, longer;
  first.outcome = same.outcome = slow;
  EXPECT_EQ(run(study, first, {}, 5.0).rows[1].failure, "timed out: not done after 5 s");
  EXPECT_EQ(run(study, same, {}, 5.0).rows[1].failure, "timed out: not done after 5 s");
  EXPECT_EQ(same.runs(), 0);
  EXPECT_TRUE(run(study, longer, {}, 6.0).rows[1].completed());
  EXPECT_EQ(longer.runs(), 1);
}

TEST_F(StoredSweep, CountsWhatHasToRun) {
  const StudyFile study = two_by_two_by_two_of();
  const Estimate before = estimate_in_store(study);
  EXPECT_EQ(before.cases, 8u);
  EXPECT_EQ(before.runs, 4u);
  EXPECT_EQ(before.stored, 0u);
  EXPECT_GT(before.memory, 0.0);
  double sum = 0;
  for (const CaseRuns& each : case_runs(study, 1)) sum += each.runs.front().cost;
  EXPECT_DOUBLE_EQ(before.updates, sum);
  EXPECT_DOUBLE_EQ(before.time(1e6), sum / 1e6 / 2.0) << "two at a time";

  Counting counting;
  run(study, counting);
  const Estimate after = estimate_in_store(study);
  EXPECT_EQ(after.stored, 4u);
  EXPECT_EQ(after.updates, 0.0);
}

}  // namespace
}  // namespace launchsafe::study
