#include "launchsafe/study/critical_gap.hpp"

#include "case_runs.hpp"
#include "case_uncertainty.hpp"
#include "gap_analysis.hpp"
#include "launchsafe/store/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace launchsafe::study {

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

double GapVerdict::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return maximum.temperature - reference->maximum_temperature;
}

double GapVerdict::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

bool CriticalGapResult::any_failed() const {
  return std::any_of(cases.begin(), cases.end(), [](const CaseOutcome& each) {
    return !each.completed() ||
           std::any_of(each.confirmations.begin(), each.confirmations.end(),
                       [](const Confirmation& confirmation) { return !confirmation.completed; });
  });
}

bool CriticalGapResult::any_indeterminate() const {
  return std::any_of(cases.begin(), cases.end(), [](const CaseOutcome& each) {
    return each.critical.kind == CriticalGapKind::indeterminate ||
           std::any_of(each.verdicts.begin(), each.verdicts.end(),
                       [](const GapVerdict& row) { return row.judgement.verdict == Verdict::indeterminate; });
  });
}

namespace {

detail::NeededRun mechanics_of(const CaseOutcome& outcome) {
  return {&outcome.input.scene.scene, outcome.input.label, std::nullopt};
}

detail::NeededRun coupled_of(const CaseOutcome& outcome, double gap) {
  return {&outcome.input.scene.scene,
          fmt::format("{}, coupled at {:.6g} cm", outcome.input.label, 100.0 * gap), gap};
}

/// A case without a run: rows without numbers, and the reason.
void give_up(const Study& study, CaseOutcome& outcome, std::string failure) {
  // Whatever was left half done is thrown away.
  const CaseOutcome broken = std::move(outcome);
  outcome = CaseOutcome{};
  outcome.input = broken.input;
  outcome.start_time = broken.start_time;
  outcome.failure = std::move(failure);
  detail::find_critical_gaps(study, outcome);
  detail::evaluate_gaps(study, outcome);
}

/// The mechanics of every case of our shard, each with its traced gaps.
void run_mechanics(CriticalGapResult& result, const std::vector<bool>& ours, const StudyOptions& options,
                   ProgressTracker& tracker) {
  std::vector<Task> tasks;
  std::vector<std::size_t> indices;
  std::vector<detail::ObtainedRun> raised(result.cases.size());
  const bool propagated = detail::propagates_spread(result.study.study);
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    CaseOutcome& outcome = result.cases[i];
    if (!ours[i]) {
      give_up(result.study.study, outcome, foreign_shard);
      continue;
    }
    indices.push_back(i);
    tasks.push_back(detail::task_of(mechanics_of(outcome), options, [&, i](const Allotment& allotment) {
      outcome.start_time = store::utc_now();
      detail::ObtainedRun run = detail::obtain(mechanics_of(outcome), options, allotment);
      outcome.reused = run.reused;
      outcome.result.mechanics = std::move(run.result.mechanics);
      outcome.failure = detail::failure_of(outcome.result.mechanics, {true, {}});
      if (propagated && outcome.completed()) {
        raised[i] = detail::obtain_raised(outcome.input, options, allotment.threads);
        outcome.raised = raised[i].result.mechanics;
      }
      detail::find_critical_gaps(result.study.study, outcome);
      detail::evaluate_gaps(result.study.study, outcome);
      detail::evaluate_film(result.study.study, outcome);
    }));
    if (propagated) tasks.back().cost *= 2.0;
    tracker.expect(1, tasks.back().cost);
  }
  const auto outcomes = run_tasks(tasks, detail::resources_of(options), tracker, options.stop);
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    CaseOutcome& outcome = result.cases[indices[task]];
    if (outcome.raised) {
      const detail::ObtainedRun& run = raised[indices[task]];
      detail::add_run(result.timing, run.result.mechanics, run.reused, outcomes[task]);
    }
    detail::add_run(result.timing, outcome.result.mechanics, outcome.reused, outcomes[task]);
    if (outcomes[task].started && outcomes[task].failure.empty()) continue;
    detail::note_refusal(mechanics_of(outcome), outcomes[task], options);
    give_up(result.study.study, outcome, detail::failure_of(outcome.result.mechanics, outcomes[task]));
  }
}

Confirmation expectation(double gap, bool ignition) {
  Confirmation confirmation;
  confirmation.gap = gap;
  confirmation.expected_ignition = ignition;
  return confirmation;
}

Confirmation confirm(const CaseOutcome& outcome, double gap, const StudyOptions& options,
                     const Allotment& allotment, detail::ObtainedRun& run, bool expected) {
  const scene::Scene& scene = outcome.input.scene.scene;
  run = detail::obtain(coupled_of(outcome, gap), options, allotment);
  const run::CaseResult& coupled = run.result;
  const run::MechanicsResult& mechanics = coupled.mechanics;
  Confirmation confirmation = expectation(gap, expected);
  confirmation.ran = true;
  confirmation.wall_time = mechanics.wall_time;
  confirmation.failure = detail::failure_of(mechanics, {true, {}});
  if (!confirmation.failure.empty()) return confirmation;
  if (coupled.gaps.empty() || !std::isfinite(coupled.gaps.front().at_points.temperature)) {
    confirmation.failure = "its temperature is not a number";
    return confirmation;
  }
  confirmation.completed = true;
  confirmation.ignited = coupled.gaps.front().skin.ignition.has_value();
  confirmation.maximum_temperature = coupled.gaps.front().at_points.temperature;
  const run::GapResult traced = run::evaluate_gap(scene, outcome.result.mechanics.trace, gap);
  if (!confirmation.ignited && !traced.skin.ignition)
    confirmation.difference = confirmation.maximum_temperature - traced.at_points.temperature;
  return confirmation;
}

/// The places at which confirmations go, and the runs they came from.
struct Planned {
  CaseOutcome* outcome;
  std::size_t side;
  detail::ObtainedRun run = {};
};

std::vector<Planned> plan_confirmations(CriticalGapResult& result) {
  std::vector<Planned> planned;
  for (CaseOutcome& outcome : result.cases) {
    if (outcome.critical.kind != CriticalGapKind::value) continue;
    outcome.confirmations = {expectation(outcome.critical.lower, false),
                             expectation(outcome.critical.upper, true)};
    for (std::size_t side = 0; side < 2; ++side) planned.push_back({&outcome, side});
  }
  return planned;
}

/// Complete coupled runs on both sides of every bracket.
void run_confirmations(CriticalGapResult& result, const StudyOptions& options, ProgressTracker& tracker) {
  std::vector<Planned> planned = plan_confirmations(result);
  std::vector<Task> tasks;
  for (Planned& each : planned) {
    Confirmation& place = each.outcome->confirmations[each.side];
    tasks.push_back(
        detail::task_of(coupled_of(*each.outcome, place.gap), options, [&](const Allotment& allotment) {
          place = confirm(*each.outcome, place.gap, options, allotment, each.run, place.expected_ignition);
        }));
  }
  const auto outcomes = run_tasks(tasks, detail::resources_of(options), tracker, options.stop);
  for (std::size_t i = 0; i < planned.size(); ++i) {
    detail::add_run(result.timing, planned[i].run.result.mechanics, planned[i].run.reused, outcomes[i]);
    Confirmation& confirmation = planned[i].outcome->confirmations[planned[i].side];
    if (outcomes[i].started && outcomes[i].failure.empty()) continue;
    detail::note_refusal(coupled_of(*planned[i].outcome, confirmation.gap), outcomes[i], options);
    confirmation.ran = true;
    confirmation.completed = false;
    confirmation.failure = detail::failure_of({}, outcomes[i]);
  }
}

/// Takes back the progress of confirmations that no bracket needs.
void expect_confirmations(const CriticalGapResult& result, const StudyOptions& options,
                          ProgressTracker& tracker, bool before) {
  for (const CaseOutcome& outcome : result.cases) {
    if (!detail::refusal_of(mechanics_of(outcome), options).empty()) continue;
    const double cost = 2.0 * detail::cost_of(outcome.input.scene.scene);
    if (before) {
      tracker.expect(2, cost);
    } else if (outcome.critical.kind != CriticalGapKind::value) {
      tracker.expect(-2, -cost);
    }
  }
}

}  // namespace

CriticalGapResult run_critical_gap(const StudyFile& study, const StudyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  CriticalGapResult result;
  result.study = study;
  result.timing.jobs = detail::jobs_of(options);
  ProgressTracker tracker(options.progress);
  const std::vector<bool> ours = detail::cases_of_shard(study, options.shard);
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    CaseOutcome outcome;
    outcome.input = study.cases[i];
    result.cases.push_back(std::move(outcome));
  }
  if (study.study.confirm) expect_confirmations(result, options, tracker, true);
  run_mechanics(result, ours, options, tracker);
  if (study.study.confirm) {
    expect_confirmations(result, options, tracker, false);
    run_confirmations(result, options, tracker);
  }
  for (CaseOutcome& outcome : result.cases) {
    detail::apply_confirmations(study.study, outcome);
    detail::conclude(study.study, outcome);
  }
  result.interrupted = detail::stop_requested(options);
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace launchsafe::study
