#include "launchsafe/kinds/critical_gap.hpp"

#include "launchsafe/report/quantities.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/study/answer_cases.hpp"
#include "launchsafe/study/closing_gaps.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/study/run_cases.hpp"
#include "study_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using study::CaseOutcome, study::CaseRun, study::CaseRuns, study::Confirmation, study::FinishedRun,
    study::ProgressTracker, study::StudyOptions;

std::string label_with_skin(const CaseOutcome& outcome, double gap) {
  return fmt::format("{}, coupled at {}", outcome.input.label, report::centimetres(gap));
}

bool CriticalGapResult::any_indeterminate() const {
  return std::ranges::any_of(answers, is_indeterminate<study::CaseAnswer>);
}

namespace {

/// One case on its runs: the mechanics, those under a raised load where there are, and of its longer launch.
CaseOutcome judged(const study::Study& study, const study::StudyCase& input, std::vector<FinishedRun> runs) {
  std::optional<FinishedRun> longer_launch;
  if (scene::longer_launch(input.scene.scene.load)) {
    longer_launch = std::move(runs.back());
    runs.pop_back();
  }
  if (const FinishedRun* run = run_without_result(runs))
    return without_result(study, input, run->outcome, run->failure);
  CaseOutcome outcome;
  outcome.input = input;
  outcome.outcome = runs.front().outcome;
  outcome.failure = runs.front().failure;
  outcome.result.mechanics = std::move(runs.front().result.mechanics);
  if (runs.size() > 1 && outcome.completed()) {
    outcome.raised = std::move(runs[1].result.mechanics);
    outcome.raised->monitor.clear();
    outcome.raised->snapshots.clear();
  }
  evaluate(study, outcome);
  evaluate_film(study, outcome);
  if (longer_launch && outcome.completed()) {
    run::MechanicsResult& mechanics = longer_launch->result.mechanics;
    if (!longer_launch->has_result()) {
      mechanics.status = run::RunStatus::interrupted;
      mechanics.reason = longer_launch->failure;
    }
    evaluate_longer_launch(study, mechanics, outcome);
  }
  return outcome;
}

Confirmation expectation(double gap, bool ignition) {
  Confirmation confirmation;
  confirmation.gap = gap;
  confirmation.expected_ignition = ignition;
  return confirmation;
}

void take_confirmation(const CaseOutcome& outcome, const FinishedRun& run, Confirmation& confirmation) {
  confirmation.ran = true;
  confirmation.outcome = run.outcome;
  confirmation.failure = run.failure;
  const std::vector<run::GapResult>& gaps = run.result.gaps;
  if (!gaps.empty()) confirmation.combustion = gaps.front().combustion;
  // What breaks off by itself after it has ignited has ignited. How far a run that was cut off came depends
  // on the machine.
  const bool cut_off = run.outcome != study::RunOutcome::ran && run.outcome != study::RunOutcome::reused;
  if (!confirmation.failure.empty() && (cut_off || !confirmation.combustion)) return;
  if (gaps.empty() || !std::isfinite(gaps.front().at_stations.temperature)) {
    confirmation.failure = "its temperature is not a number";
    return;
  }
  confirmation.completed = true;
  confirmation.ignited = gaps.front().skin.ignition.has_value();
  confirmation.maximum_temperature = gaps.front().at_stations.temperature;
  const run::GapResult traced =
      run::evaluate_gap(outcome.input.scene.scene, outcome.result.mechanics.trace, confirmation.gap);
  if (!confirmation.ignited && !traced.skin.ignition)
    confirmation.difference = confirmation.maximum_temperature - traced.at_stations.temperature;
}

/// Coupled runs on both sides of every bracket, from checkpoints of the mechanics where those were computed.
void run_confirmations(CriticalGapResult& result, const StudyOptions& options, ProgressTracker& tracker) {
  std::vector<CaseRuns> runs;
  std::vector<std::pair<CaseOutcome*, std::size_t>> places;
  for (CaseOutcome& outcome : result.details) {
    if (outcome.critical.kind != study::CriticalGapKind::value) continue;
    outcome.confirmations = {expectation(outcome.critical.lower, false),
                             expectation(outcome.critical.upper, true)};
    for (std::size_t side = 0; side < 2; ++side) {
      const double gap = outcome.confirmations[side].gap;
      CaseRun run = study::skin_run(outcome.input.scene.scene, gap, label_with_skin(outcome, gap));
      run.launch = &outcome.result.mechanics;
      if (run.launch->checkpoints) run.cost = continued_cost(run);
      runs.push_back({{}, {planned_run(std::move(run))}, options.shard.index});
      places.emplace_back(&outcome, side);
    }
  }
  run_cases(runs, options, tracker, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    const auto [outcome, side] = places[i];
    take_confirmation(*outcome, finished.front(), outcome->confirmations[side]);
  });
  for (CaseOutcome& outcome : result.details) outcome.result.mechanics.checkpoints.reset();
}

/// The launches of gaps that close, for the cases that ask for them.
void run_closing_gaps(CriticalGapResult& result, const StudyOptions& options, ProgressTracker& tracker) {
  const study::RunBatch run = [&](std::vector<CaseRun> runs) {
    std::vector<FinishedRun> all(runs.size());
    std::vector<CaseRuns> tasks;
    for (CaseRun& each : runs) tasks.push_back({{}, {planned_run(std::move(each))}, options.shard.index});
    run_cases(tasks, options, tracker, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
      all[i] = std::move(finished.front());
    });
    return all;
  };
  for (CaseOutcome& outcome : result.details)
    if (outcome.input.closing && outcome.completed())
      outcome.closing = find_closing_gaps(result.study.study, outcome.input, run);
}

void run_in_detail(CriticalGapResult& result, const StudyOptions& options) {
  const study::StudyFile& study = result.study;
  const bool confirm = study.confirmations_per_case > 0;
  ProgressTracker tracker(options.progress);
  result.details.resize(study.cases.size());
  const std::vector<CaseRuns> runs = case_runs(study, options.shard.count, confirm);
  run_cases(runs, options, tracker, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    for (const std::size_t member : runs[i].members) {
      result.details[member] = judged(study.study, study.cases[member], finished);
      result.details[member].hash = finished.front().hash;
    }
  });
  if (confirm) run_confirmations(result, options, tracker);
  run_closing_gaps(result, options, tracker);
  for (CaseOutcome& outcome : result.details) {
    apply_confirmations(study.study, outcome);
    conclude(study.study, outcome);
    result.answers.push_back(answer_of(outcome));
  }
}

}  // namespace

CriticalGapResult run_critical_gap(const study::StudyFile& study, const StudyOptions& options) {
  return run_timed<CriticalGapResult>(
      study, options,
      [&](CriticalGapResult& result) {
        if (study.study.in_detail)
          run_in_detail(result, options);
        else
          result.answers = answer_cases(study, options, result.timing);
      },
      [](CriticalGapResult&) {});
}

}  // namespace launchsafe::kinds
