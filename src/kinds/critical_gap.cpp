#include "critical_gap_tables.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::kinds {

using study::CaseRun, study::CaseRuns, study::Confirmation, study::PlannedRun, study::ProgressTracker;

namespace {

/// A study of at most this many cases is in detail (Study::in_detail): histories are kept, and coupled runs
/// confirm the critical gap unless the study says otherwise. A study of more cases keeps their rows alone,
/// unless it asks for confirmation.
constexpr std::size_t most_cases_in_detail = 6;

/// The coupled run that confirms a gap (m) of a case: "496 MPa, 30 µm, 1 mm, coupled at 0.04 cm". Journals
/// of stored studies name it so.
std::string label_with_skin(const CaseInDetail& of_case, double gap) {
  return fmt::format("{}, coupled at {}", of_case.input.label, centimetres(gap));
}

void take_confirmation(const FinishedRun& run, Confirmation& confirmation) {
  confirmation.ran = true;
  confirmation.outcome = run.outcome;
  confirmation.failure = run.failure;
  const std::vector<run::GapResult>& gaps = run.result.gaps;
  if (!gaps.empty()) confirmation.combustion = gaps.front().combustion;
  // What breaks off by itself after it has ignited has ignited. How far a run that was cut off came depends
  // on the machine.
  const bool cut_off = run.outcome != RunOutcome::ran && run.outcome != RunOutcome::reused;
  if (!confirmation.failure.empty() && (cut_off || !confirmation.combustion)) return;
  if (gaps.empty() || !std::isfinite(gaps.front().at_stations.temperature)) {
    confirmation.failure = "its temperature is not a number";
    return;
  }
  confirmation.completed = true;
  confirmation.ignited = gaps.front().skin.ignition.has_value();
  confirmation.maximum_temperature = gaps.front().at_stations.temperature;
}

/// Coupled runs that confirm what launches show, and what takes each.
struct FollowingRuns {
  using Taker = std::function<void(const FinishedRun&)>;
  std::vector<PlannedRun> runs = {};
  std::vector<Taker> takers = {};

  /// On both sides of its critical gap.
  void add_confirmations(CaseInDetail& of_case) {
    const CriticalGap& critical = of_case.critical;
    if (critical.kind != CriticalGapKind::value) return;
    of_case.confirmations = {{.gap = std::max(0.0, critical.value - confirm_distance)},
                             {.gap = critical.value + confirm_distance, .expected_ignition = true}};
    for (Confirmation& each : of_case.confirmations) {
      runs.push_back(planned_run(
          study::skin_run(of_case.input.scene.scene, each.gap, label_with_skin(of_case, each.gap))));
      takers.push_back([&each](const FinishedRun& finished) { take_confirmation(finished, each); });
    }
  }
};

void run_in_detail(CriticalGapResult& result, const StudyOptions& options) {
  const StudyFile& study = result.study;
  const bool confirm = study.confirmations_per_case > 0;
  ProgressTracker tracker(options.progress);
  result.details.resize(study.cases.size());
  const std::vector<CaseRuns> runs = case_runs(study, options.shard.count);
  double foreseen = 0;
  if (confirm)
    for (const CaseRuns& each : runs)
      foreseen +=
          static_cast<double>(study.confirmations_per_case * each.members.size()) * each.runs.front().cost;
  tracker.expect(0, foreseen);
  run_cases(runs, options, tracker, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    for (const std::size_t member : runs[i].members)
      result.details[member] = draw_case(study.study, study.cases[member], finished);
  });
  FollowingRuns following;
  if (confirm)
    std::ranges::for_each(result.details, [&](CaseInDetail& each) { following.add_confirmations(each); });
  tracker.begin(study::Phase::following_runs);
  tracker.expect(0, -foreseen);
  run_each(std::move(following.runs), options, tracker, result.timing,
           [&](std::size_t i, const FinishedRun& finished) { following.takers[i](finished); });
  tracker.begin(study::Phase::report);
  for (CaseInDetail& each : result.details) {
    apply_confirmations(each);
    result.rows.push_back(each);
  }
}

/// Of many cases the rows alone.
void run_many(CriticalGapResult& result, const StudyOptions& options) {
  ProgressTracker tracker(options.progress);
  result.rows = draw_rows(result.study, options, result.timing, tracker);
}

const std::vector<Key<CriticalGapSettings>> critical_gap_keys{
    flag_key("confirm", Standing::assumed,
             fmt::format("Coupled runs on both sides of the critical gap: the skin in the mechanics, and on "
                         "through combustion. Of a study with more than {} cases it is false unless stated.",
                         most_cases_in_detail),
             &CriticalGapSettings::confirm),
};

void make_critical_gap_cases(const StudySource& source, StudyFile& study) {
  read_references(source, study);
  make_factorial(study);
  const bool few = study.cases.size() <= most_cases_in_detail;
  bool& confirm = settings_of<CriticalGapSettings>(study.study).confirm;
  if (!study.places.contains("confirm")) confirm = few;
  study.study.in_detail = few || confirm;
  study.confirmations_per_case = confirm ? 2 : 0;
}

std::vector<Failure> critical_gap_failures(const CriticalGapResult& result) {
  std::vector<Failure> failures = failures_of(result);
  for (const CaseInDetail& each : result.details)
    for (const study::Confirmation& confirmation : each.confirmations)
      add_failure(failures, label_with_skin(each, confirmation.gap), confirmation);
  return failures;
}

}  // namespace

CriticalGapResult run_critical_gap(const StudyFile& study, const StudyOptions& options) {
  return run_timed<CriticalGapResult>(study, options, [&](CriticalGapResult& result) {
    study.study.in_detail ? run_in_detail(result, options) : run_many(result, options);
  });
}

Kind critical_gap_kind() {
  return {
      .traits = {.name = "critical-gap"},
      .keys =
          joined({reference_keys(), gaps_keys(), search_keys(), own_keys(critical_gap_keys), verdict_keys()}),
      .tables = {reference_table(), vary_table()},
      .varies = {.values = true},
      .make_cases = make_critical_gap_cases,
      .run = outcome_of<run_critical_gap, critical_gap_failures>,
      .results = critical_gap_results,
  };
}

}  // namespace launchsafe::kinds
