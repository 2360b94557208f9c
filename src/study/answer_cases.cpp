#include "launchsafe/study/answer_cases.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/firing_record.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/study/stored_answer.hpp"
#include "launchsafe/version.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <optional>

namespace launchsafe::study {
namespace {

/// Of what of a study influences an answer, and of the build, since answers are cheap to draw again, while
/// one of an older program may be wrong.
std::string digest_of_analysis(const Study& study) {
  std::string text =
      fmt::format("# answer of launchsafe {} {}, model version {}\n{} {} {} {} {} {} {} {}\n",
                  version::number, version::commit, run::model_version, fmt::join(study.gaps, ","),
                  study.tolerance, study.largest_gap, study.fit_uncertainty, study.input_uncertainty,
                  study.early_time, study.reference_line.slope, study.reference_line.intercept);
  for (const Reference& row : study.references) {
    text += fmt::format("{} {} {} {} {} {} {}\n", row.gap, row.maximum_temperature, row.early_temperature,
                        row.spread, row.early_spread, row.ignition_time, row.calibrated);
  }
  const CalibrationEvidence& evidence = study.calibration.evidence;
  text += fmt::format("{} {} {} {}\n", evidence.friction_rise, evidence.air_rise, evidence.largest_gap,
                      evidence.fit_uncertainty) +
          scene::to_toml(study.calibration.scene);
  if (study.calibration.firings) text += to_text(*study.calibration.firings);
  text += fmt::format("{}\n", study.model_form_uncertainty);
  if (study.model_form) text += to_json_text(*study.model_form);
  for (const scene::Implausible& each : study.implausible)
    text += fmt::format("{} {} {}\n", each.key, each.value, each.because);
  return store::sha256(text);
}

/// The stored answer to a case that rests on so many runs, if it is there and can be one. What is not is
/// drawn again from the mechanics; a damaged result is computed again, also where its answers are known.
std::optional<CaseAnswer> stored_answer(const Study& study, const StudyCase& input, const std::string& key,
                                        std::size_t runs, store::CaseStore& store) {
  auto answer = read_answer(store, key);
  const auto is_held = [&store](const std::string& hash) { return store.holds(hash); };
  if (!answer || answer->runs.size() != runs || !std::ranges::all_of(answer->runs, is_held))
    return std::nullopt;
  answer = judged(std::move(*answer), study, input);
  if (!answer) return std::nullopt;
  answer->runs.clear();  // there may be a million answers
  // References are not stored: they are the study's.
  attach_references(study, input, answer->verdicts);
  return answer;
}

/// The key of the stored answer of a case: all that determines it and its runs. `analysis`: digest of what of
/// the study does.
std::string answer_key(const std::string& analysis, const StudyCase& input) {
  scene::Scene scene = input.scene.scene;
  scene::clear_remarks(scene);
  scene.surface.gaps = {};
  return store::CaseIdentity(analysis + (input.own_conditions ? "own" : "other") +
                             fmt::format(" {} {}\n", input.numerical_uncertainty, input.rise_of_uncertainty) +
                             scene::to_toml(scene))
      .hash();
}

/// Takes from the store the answers that are there, and draws the others from runs.
class AnswerRunner {
 public:
  AnswerRunner(const StudyFile& study, const StudyOptions& options, Timing& timing)
      : study_(study),
        options_(options),
        timing_(timing),
        analysis_(digest_of_analysis(study.study)),
        cases_(case_runs(study, options.shard.count)),
        answers_(study.cases.size()) {}

  std::vector<CaseAnswer> answer_all() {
    fetch_stored();
    ProgressTracker tracker(options_.progress);
    const std::vector<CaseRuns> open = without_answered(tracker);
    run_cases(open, options_, tracker, timing_, [&](std::size_t i, std::vector<FinishedRun>& runs) {
      answer_members(open_[i], runs);
      for (const std::size_t member : open_[i]) tell(tracker, member);
    });
    std::vector<CaseAnswer> result;
    for (auto& answer : answers_) result.push_back(std::move(*answer));
    return result;
  }

 private:
  void tell(ProgressTracker& tracker, std::size_t i) const {
    if (answers_[i]->critical.kind == CriticalGapKind::value)
      tracker.found({study_.cases.label(i), answers_[i]->critical.lower, answers_[i]->critical.upper});
  }

  void fetch_stored() {
    if (options_.store == nullptr || options_.store->records().empty()) return;
    tbb::parallel_for(std::size_t{0}, cases_.size(), [this](std::size_t i) {
      if (cases_[i].shard == options_.shard.index && !stop_requested(options_)) fetch_answers(cases_[i]);
    });
  }

  void fetch_answers(const CaseRuns& runs) {
    for (const std::size_t each : runs.members) {
      const StudyCase input = study_.cases[each];
      answers_[each] =
          stored_answer(study_.study, input, answer_key(analysis_, input), runs.runs.size(), *options_.store);
    }
  }

  /// The runs behind which some case still needs an answer.
  std::vector<CaseRuns> without_answered(ProgressTracker& tracker) {
    std::vector<CaseRuns> open;
    std::map<std::string, std::size_t> answered_cases;  // by the reason why they failed, empty for none
    for (CaseRuns& each : cases_) {
      const bool answered = std::all_of(each.members.begin(), each.members.end(),
                                        [this](std::size_t member) { return answers_[member].has_value(); });
      if (answered) {
        timing_.reused += each.runs.size();
        tracker.expect_cases(each.members.size());
        for (const std::size_t member : each.members) {
          tell(tracker, member);
          ++answered_cases[answers_[member]->failure];
        }
      } else {
        open_.push_back(each.members);
        open.push_back(std::move(each));
      }
    }
    for (const auto& [failure, cases] : answered_cases) tracker.cases_ended(cases, failure);
    return open;
  }

  void answer_members(const std::vector<std::size_t>& members, const std::vector<FinishedRun>& runs) {
    // Cores that find no further run help here. A thread that waits for them must not start another run.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t i) {
        if (answers_[members[i]]) return;
        const FinishedRun* lacking = run_without_result(runs);
        answers_[members[i]] = lacking != nullptr && is_of_no_report(*lacking)
                                   ? without_rows(*lacking)
                                   : answer(study_.cases[members[i]], runs);
      });
    });
  }

  /// A study that was stopped, and a shard, report nothing: there may be a million such cases.
  bool is_of_no_report(const FinishedRun& lacking) const {
    return lacking.outcome == RunOutcome::other_shard || stop_requested(options_);
  }

  static CaseAnswer without_rows(const FinishedRun& lacking) {
    CaseAnswer answer;
    answer.outcome = lacking.outcome;
    answer.failure = lacking.failure;
    return answer;
  }

  CaseAnswer answer(const StudyCase& input, const std::vector<FinishedRun>& runs) {
    const bool judged = run_without_result(runs) == nullptr;
    if (judged && stop_requested(options_))
      return failed_answer(study_.study, input, RunOutcome::interrupted,
                           "interrupted before its gaps were judged");
    CaseAnswer answer = answer_from(study_.study, input, runs);
    if (!judged || was_cut_off(runs.front())) return answer;
    if (options_.store != nullptr && std::none_of(runs.begin(), runs.end(), was_cut_off)) {
      for (const FinishedRun& run : runs) answer.runs.push_back(run.hash);
      save_answer(*options_.store, answer_key(analysis_, input), answer);
      answer.runs.clear();
    }
    return answer;
  }

  const StudyFile& study_;
  const StudyOptions& options_;
  Timing& timing_;
  std::string analysis_;
  std::vector<CaseRuns> cases_;
  std::vector<std::optional<CaseAnswer>> answers_;
  std::vector<std::vector<std::size_t>> open_;  ///< members of the cases that are run
};

}  // namespace

bool was_cut_off(const FinishedRun& run) {
  return run.outcome == RunOutcome::timed_out || run.outcome == RunOutcome::interrupted;
}

CaseAnswer answer_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  if (const FinishedRun* run = run_without_result(runs))
    return failed_answer(study, input, run->outcome, run->failure);
  const FinishedRun& own = runs.front();
  if (was_cut_off(own)) {
    CaseAnswer answer = failed_answer(study, input, own.outcome, own.failure);
    answer.run.status = own.result.mechanics.status;
    return answer;
  }
  std::optional<run::MechanicsResult> raised;
  if (runs.size() > 1 && own.failure.empty()) raised = runs[1].result.mechanics;
  CaseAnswer answer = answer_of(study, input, own.result.mechanics, raised);
  answer.outcome = own.outcome;
  return answer;
}

std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing) {
  return AnswerRunner(study, options, timing).answer_all();
}

}  // namespace launchsafe::study
