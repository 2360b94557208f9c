#include "launchsafe/study/case_answer.hpp"

#include "launchsafe/study/constants_of_study.hpp"
#include "launchsafe/version.hpp"

#include <tbb/parallel_for.h>

namespace launchsafe::study {
namespace {

/// Of what of a study influences an answer, and of the build, since answers are cheap to draw again, while
/// one of an older program may be wrong.
std::string digest_of_analysis(const Study& study) {
  std::string text =
      fmt::format("# answer of launchsafe {} {}, model version {}\n{} {} {} {} {} {}\n", version::number,
                  version::commit, run::model_version, fmt::join(study.gaps, ","), study.tolerance,
                  study.largest_gap, study.fit_uncertainty, study.input_uncertainty, study.early_time);
  const CalibrationEvidence& evidence = study.calibration.evidence;
  text += fmt::format("{} {} {} {}\n{}\n", evidence.friction_rise, evidence.air_rise, evidence.largest_gap,
                      evidence.fit_uncertainty, scene::to_toml(study.calibration.scene));
  for (const auto& model : study.models)
    text += fmt::format("{}\n{}\n", name_of_model(*model), scene::to_toml(*model));
  for (const scene::Implausible& each : study.implausible)
    text += fmt::format("{} {} {}\n", each.key, each.value, each.because);
  return store::sha256(text);
}

/// The stored answer to a case that rests on so many runs, whose results are there too. What is not is drawn
/// again from the mechanics.
std::optional<CaseAnswer> stored_answer(const Study& study, const StudyCase& input, const std::string& key,
                                        std::size_t runs, store::CaseStore& store) {
  std::optional<CaseAnswer> answer;
  store.read([&](store::Database& database) { answer = read_answer(database, key); });
  const auto is_held = [&store](const std::string& hash) { return store.holds(hash); };
  if (!answer || answer->runs.size() != runs || !std::ranges::all_of(answer->runs, is_held))
    return std::nullopt;
  answer = judged(std::move(*answer), study, input);
  answer->runs.clear();  // there may be a million answers
  // References are not stored: they are the study's.
  attach_references(study, input, answer->verdicts);
  return answer;
}

/// The key of the stored answer of a case: all that determines it and its runs. `analysis`: digest of what of
/// the study does.
std::string answer_key(const std::string& analysis, const Study& study, const StudyCase& input) {
  scene::Scene scene = input.scene.scene;
  scene::clear_remarks(scene);
  scene.surface.gaps = {};
  std::string text = analysis + (input.own_conditions ? "own" : "other") +
                     fmt::format(" {} {}\n", input.numerical_uncertainty, input.rise_of_uncertainty) +
                     scene::to_toml(scene);
  // Equal scenes differ under other constants where one states what the other takes from its own.
  for (const auto& model : study.models) text += scene::to_toml(scene_of_model(input, model));
  return store::CaseIdentity(text).hash();
}

/// Takes from the store the answers that are there, and draws the others from runs.
struct AnswerRunner {
  const StudyFile& study;
  const StudyOptions& options;
  Timing& timing;
  ProgressTracker& tracker;
  std::string analysis = digest_of_analysis(study.study);
  std::vector<CaseRuns> cases = case_runs(study, options.shard.count);
  std::vector<std::optional<CaseAnswer>> answers = std::vector<std::optional<CaseAnswer>>(study.cases.size());

  std::vector<CaseAnswer> answer_all() {
    fetch_stored();
    drop_answered();
    run_cases(cases, options, tracker, timing,
              [&](std::size_t i, std::vector<FinishedRun>& runs) { answer_members(cases[i].members, runs); });
    std::vector<CaseAnswer> result;
    for (auto& answer : answers) result.push_back(std::move(*answer));
    return result;
  }

  void fetch_stored() {
    if (options.store == nullptr || options.store->records().empty()) return;
    tbb::parallel_for(std::size_t{0}, cases.size(), [this](std::size_t i) {
      if (cases[i].shard != options.shard.index || stop_requested(options)) return;
      for (const std::size_t each : cases[i].members) {
        const StudyCase input = study.cases[each];
        answers[each] = stored_answer(study.study, input, answer_key(analysis, study.study, input),
                                      cases[i].runs.size(), *options.store);
      }
    });
  }

  /// Leaves the runs behind which some case still needs an answer.
  void drop_answered() {
    std::ptrdiff_t answered = 0, failed = 0;  // cases
    const auto is_answered = [this](std::size_t member) { return answers[member].has_value(); };
    std::erase_if(cases, [&](const CaseRuns& each) {
      if (!std::ranges::all_of(each.members, is_answered)) return false;
      timing.reused += each.runs.size();
      tracker.expect_cases(each.members.size());
      for (const std::size_t member : each.members) ++(answers[member]->failure.empty() ? answered : failed);
      return true;
    });
    tracker.cases_ended(answered, false);
    tracker.cases_ended(failed, true);
  }

  void answer_members(const std::vector<std::size_t>& members, std::vector<FinishedRun>& runs) {
    const std::vector<std::string> hashes = of_each(runs, &FinishedRun::hash);
    run_parts(members.size(), [&](std::size_t i) {
      if (answers[members[i]]) return;
      const FinishedRun* lacking = run_without_result(runs);
      // A study that was stopped, and a shard, report nothing: there may be a million such cases.
      if (lacking == nullptr || !(lacking->outcome == RunOutcome::other_shard || stop_requested(options))) {
        answers[members[i]] = answer(members[i], runs, hashes);
        return;
      }
      CaseAnswer& without_rows = answers[members[i]].emplace();
      without_rows.outcome = lacking->outcome;
      without_rows.failure = lacking->failure;
    });
    // Progress counts the case as left.
    if (std::ranges::any_of(
            members, [&](std::size_t member) { return answers[member]->outcome == RunOutcome::interrupted; }))
      runs.front().outcome = RunOutcome::interrupted;
  }

  /// `hashes`: of all runs that the answer rests on.
  CaseAnswer answer(std::size_t member, const std::vector<FinishedRun>& runs,
                    const std::vector<std::string>& hashes) {
    const StudyCase input = study.cases[member];
    const bool judged = run_without_result(runs) == nullptr;
    if (judged && stop_requested(options))
      return failed_answer(study.study, input, RunOutcome::interrupted,
                           "interrupted before its gaps were judged");
    CaseAnswer answer = answer_from(study.study, input, runs);
    if (judged && options.store != nullptr && std::ranges::none_of(runs, was_cut_off)) {
      answer.runs = hashes;
      options.store->write([&](store::Database& database) {
        return save_answer(database, answer_key(analysis, study.study, input), answer);
      });
      answer.runs.clear();
    }
    return answer;
  }
};

}  // namespace

CaseAnswer answer_of(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics,
                     const std::optional<run::MechanicsResult>& raised) {
  CaseOutcome outcome;
  outcome.input = input;
  outcome.result.mechanics = mechanics;
  outcome.failure = failure_of(mechanics);
  outcome.raised = raised;
  evaluate(study, outcome);
  apply_confirmations(study, outcome);
  conclude(study, outcome);
  return answer_of(outcome);
}

CaseAnswer answer_of(const CaseOutcome& outcome) {
  CaseAnswer answer = outcome;
  answer.validity_warnings = outcome.evidence->validity_warnings;
  answer.friction_rise = outcome.evidence->friction_rise;
  for (GapVerdict& row : answer.verdicts)
    if (!answer.completed()) row.heated = not_a_number;
  const run::MechanicsResult& mechanics = outcome.result.mechanics;
  answer.run = {mechanics.status, mechanics.steps, mechanics.particles, run::largest_energy_drift(mechanics),
                mechanics.limiters};
  return answer;
}

CaseAnswer failed_answer(const Study& study, const StudyCase& input, RunOutcome of_run, std::string failure) {
  CaseOutcome outcome = without_result(study, input, of_run, std::move(failure));
  conclude(study, outcome);
  return answer_of(outcome);
}

CaseAnswer judged(CaseAnswer answer, const Study& study, const StudyCase& input) {
  const auto evidence = std::make_shared<const CaseEvidence>(
      CaseEvidence{answer.failure, answer.run.limiters, answer.validity_warnings, answer.friction_rise,
                   statements_of(study, input), failed_models(answer.models)});
  // What its input says now, rather than when it was stored.
  if (GapReason reason = why_no_critical_gap(*evidence);
      reason.code != GapReasonCode::none && answer.critical.kind == CriticalGapKind::indeterminate)
    answer.critical.reason = std::move(reason);
  judge_rows(study, evidence, answer.critical, answer.verdicts);
  return answer;
}

bool was_cut_off(const FinishedRun& run) {
  return run.outcome == RunOutcome::timed_out || run.outcome == RunOutcome::interrupted;
}

CaseAnswer answer_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  const FinishedRun& own = runs.front();
  if (run_without_result(runs) == nullptr && was_cut_off(own)) {
    CaseAnswer answer = failed_answer(study, input, own.outcome, own.failure);
    answer.run.status = own.result.mechanics.status;
    return answer;
  }
  CaseOutcome outcome = outcome_from(study, input, runs);
  apply_confirmations(study, outcome);
  conclude(study, outcome);
  return answer_of(outcome);
}

CaseOutcome outcome_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  if (const FinishedRun* run = run_without_result(runs))
    return without_result(study, input, run->outcome, run->failure);
  CaseOutcome outcome;
  outcome.input = input;
  outcome.outcome = runs.front().outcome;
  outcome.failure = runs.front().failure;
  outcome.result.mechanics = runs.front().result.mechanics;
  if (outcome.completed()) {
    if (runs.size() > 1 && runs[1].model.empty()) {
      outcome.raised = runs[1].result.mechanics;
      outcome.raised->monitor.clear();
      outcome.raised->snapshots.clear();
    }
    outcome.models = gaps_of_models(study, input, runs);
  }
  evaluate(study, outcome);
  return outcome;
}

std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing,
                                     ProgressTracker& tracker) {
  return AnswerRunner{study, options, timing, tracker}.answer_all();
}

}  // namespace launchsafe::study
