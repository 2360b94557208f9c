#include "answer_cases.hpp"

#include "case_uncertainty.hpp"
#include "launchsafe/version.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>

namespace launchsafe::study::detail {
namespace {

NeededRun needed_by(const StudyCase& input) { return {&input.scene.scene, input.label, std::nullopt}; }

/// What of a study influences an answer, as text; and the build, since answers are cheap to draw again, while
/// one of an older program may be wrong.
std::string analysis_text(const Study& study) {
  std::string text = fmt::format(
      "# answer of launchsafe {} {}\n{} {} {} {} {} {} {} {}\n", version::number, version::commit,
      fmt::join(study.gaps, ","), study.tolerance, study.largest_gap, study.fit_uncertainty,
      study.input_uncertainty, study.early_time, study.reference_line.slope, study.reference_line.intercept);
  for (const Reference& row : study.references) {
    text += fmt::format("{} {} {} {} {} {} {}\n", row.gap, row.maximum_temperature, row.early_temperature,
                        row.spread, row.early_spread, row.ignition_time, row.calibrated);
  }
  const CalibrationEvidence& evidence = study.calibration.evidence;
  text += fmt::format("{} {} {} {}\n", evidence.friction_rise, evidence.air_rise, evidence.largest_gap,
                      evidence.largest_misfit) +
          scene::to_toml(study.calibration.scene);
  text += fmt::format("{}\n", study.model_form_uncertainty);
  if (study.model_form) text += to_json_text(*study.model_form);
  for (const scene::Implausible& each : study.implausible)
    text += fmt::format("{} {} {}\n", each.key, each.value, each.because);
  return text;
}

/// References are not stored: they are the study's.
void attach_references(const StudyFile& study, const StudyCase& input, CaseAnswer& answer) {
  if (!input.own_conditions) return;
  for (GapVerdict& row : answer.verdicts) {
    for (const Reference& reference : study.study.references) {
      if (std::abs(reference.gap - row.gap) <= 1e-9) row.reference = reference;
    }
  }
}

/// The stored answer to a case, if it is there and can be one. What is not is drawn again from the mechanics.
std::optional<CaseAnswer> stored_answer(const StudyFile& study, std::size_t index, const std::string& key,
                                        const StudyOptions& options) {
  if (options.store == nullptr) return std::nullopt;
  const auto line = options.store->answer(key);
  if (!line) return std::nullopt;
  auto answer = answer_from_json(*line);
  if (!answer || !fits(*answer, study.study, study.cases[index])) return std::nullopt;
  attach_references(study, study.cases[index], *answer);
  return answer;
}

class Answering {
 public:
  Answering(const StudyFile& study, const StudyOptions& options, Timing& timing)
      : study_(study),
        options_(options),
        timing_(timing),
        runs_(mechanical_runs(study, options.shard.count)),
        keys_(answer_keys(study)),
        answers_(study.cases.size()),
        tracker_(options.progress) {}

  std::vector<CaseAnswer> answer_all() {
    fetch_stored();
    run_missing();
    for (std::size_t i = 0; i < answers_.size(); ++i) {
      if (!answers_[i]) answers_[i] = failed_answer(study_.study, study_.cases[i], foreign_shard);
    }
    std::vector<CaseAnswer> result;
    for (auto& answer : answers_) result.push_back(std::move(*answer));
    return result;
  }

 private:
  bool is_ours(const MechanicalRun& run) const { return run.shard == options_.shard.index; }

  void fetch_stored() {
    if (options_.store == nullptr) return;
    tbb::parallel_for(std::size_t{0}, runs_.size(), [this](std::size_t i) {
      const MechanicalRun& run = runs_[i];
      // A damaged result is computed again, also where its answers are known.
      if (!is_ours(run) || !options_.store->holds(run.hash) || !holds_raised(run)) return;
      for (const std::size_t each : run.cases)
        answers_[each] = stored_answer(study_, each, keys_[each], options_);
    });
  }

  bool holds_raised(const MechanicalRun& run) const {
    if (!propagates_spread(study_.study)) return true;
    const scene::Scene raised = with_raised_load(study_.cases[run.cases.front()].scene.scene);
    return options_.store->holds(identity_of({&raised, {}, std::nullopt}).hash());
  }

  std::vector<std::size_t> open_cases(const MechanicalRun& run) const {
    std::vector<std::size_t> open;
    for (const std::size_t each : run.cases) {
      if (!answers_[each]) open.push_back(each);
    }
    return open;
  }

  void run_missing() {
    std::vector<Task> tasks;
    std::vector<std::vector<std::size_t>> open;
    for (const MechanicalRun& run : runs_) {
      if (!is_ours(run)) continue;
      open.push_back(open_cases(run));
      if (open.back().empty()) {
        open.pop_back();
        timing_.reused += propagates_spread(study_.study) ? 2 : 1;
      }
    }
    std::vector<ObtainedRun> obtained(open.size()), raised(open.size());
    const bool propagated = propagates_spread(study_.study);
    for (std::size_t task = 0; task < open.size(); ++task) {
      tasks.push_back(task_of(needed_by(study_.cases[open[task].front()]), options_,
                              [&, task](const Allotment& allotment) {
                                obtained[task] = answer_group(open[task], allotment, raised[task]);
                              }));
      if (propagated) tasks.back().cost *= 2.0;
      tracker_.expect(1, tasks.back().cost);
    }
    const auto outcomes = run_tasks(tasks, resources_of(options_), tracker_, options_.stop);
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      add_run(timing_, obtained[task].result.mechanics, obtained[task].reused, outcomes[task]);
      if (propagated) add_run(timing_, raised[task].result.mechanics, raised[task].reused, outcomes[task]);
      if (outcomes[task].started && outcomes[task].failure.empty()) continue;
      note_refusal(needed_by(study_.cases[open[task].front()]), outcomes[task], options_);
      const std::string failure = failure_of({}, outcomes[task]);
      for (const std::size_t each : open[task]) {
        if (!answers_[each]) answers_[each] = failed_answer(study_.study, study_.cases[each], failure);
      }
    }
  }

  /// Runs the mechanics or takes them from the store, and draws the answers. What is returned is for the
  /// account alone: its histories are gone.
  ObtainedRun answer_group(const std::vector<std::size_t>& cases, const Allotment& allotment,
                           ObtainedRun& raised) {
    ObtainedRun run = obtain(needed_by(study_.cases[cases.front()]), options_, allotment);
    run::MechanicsResult& mechanics = run.result.mechanics;
    std::optional<run::MechanicsResult> raised_mechanics;
    if (propagates_spread(study_.study) && mechanics.status == run::RunStatus::completed) {
      raised = obtain_raised(study_.cases[cases.front()], options_, allotment.threads);
      raised_mechanics = raised.result.mechanics;
      raised.result.mechanics.trace = {};
    }
    // Cores that find no further run help here. A thread that waits for them must not start another run.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, cases.size(),
                        [&](std::size_t i) { answer(cases[i], mechanics, raised_mechanics); });
    });
    mechanics.trace = {};
    mechanics.monitor.clear();
    return run;
  }

  void answer(std::size_t index, const run::MechanicsResult& mechanics,
              const std::optional<run::MechanicsResult>& raised) {
    if (stop_requested(options_)) throw std::runtime_error("interrupted before its gaps were judged");
    const StudyCase& input = study_.cases[index];
    const bool whole = !was_cut_off(mechanics) && !(raised && was_cut_off(*raised));
    CaseAnswer answer = was_cut_off(mechanics) ? cut_off_answer(input, mechanics)
                                               : answer_of(study_.study, input, mechanics, raised);
    if (whole && options_.store != nullptr) options_.store->save_answer(keys_[index], to_json_line(answer));
    attach_references(study_, input, answer);
    answers_[index] = std::move(answer);
  }

  /// How far a run came that was cut off depends on the machine, and is no part of the result.
  static bool was_cut_off(const run::MechanicsResult& mechanics) {
    return mechanics.status == run::RunStatus::interrupted || mechanics.status == run::RunStatus::timed_out;
  }
  CaseAnswer cut_off_answer(const StudyCase& input, const run::MechanicsResult& mechanics) const {
    CaseAnswer answer = failed_answer(study_.study, input, failure_of(mechanics, {true, {}}));
    answer.run.status = mechanics.status;
    return answer;
  }

  const StudyFile& study_;
  const StudyOptions& options_;
  Timing& timing_;
  std::vector<MechanicalRun> runs_;
  std::vector<std::string> keys_;
  std::vector<std::optional<CaseAnswer>> answers_;
  ProgressTracker tracker_;
};

}  // namespace

std::vector<MechanicalRun> mechanical_runs(const StudyFile& study, int shards) {
  std::vector<std::string> hashes(study.cases.size());
  tbb::parallel_for(std::size_t{0}, hashes.size(),
                    [&](std::size_t i) { hashes[i] = identity_of(needed_by(study.cases[i])).hash(); });
  std::vector<MechanicalRun> runs;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    const auto [found, is_new] = known.try_emplace(hashes[i], runs.size());
    if (is_new) runs.push_back({hashes[i], {}, cost_of(study.cases[i].scene.scene), 1});
    runs[found->second].cases.push_back(i);
  }
  std::vector<double> costs;
  for (const MechanicalRun& run : runs) costs.push_back(run.cost);
  const std::vector<int> shard = shards_of(costs, shards);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].shard = shard[i];
  return runs;
}

std::vector<std::string> answer_keys(const StudyFile& study) {
  const std::string analysis = analysis_text(study.study);
  std::vector<std::string> keys(study.cases.size());
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
    const StudyCase& input = study.cases[i];
    scene::Scene scene = input.scene.scene;
    scene.title.clear();
    scene.surface.gaps = {};
    keys[i] = store::CaseIdentity(
                  identity_of(needed_by(input)).hash() + analysis + (input.own_conditions ? "own" : "other") +
                  fmt::format(" {} {}\n", input.numerical_uncertainty, input.rise_of_uncertainty) +
                  scene::to_toml(scene))
                  .hash();
  });
  return keys;
}

std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing) {
  return Answering(study, options, timing).answer_all();
}

bool any_failed(const std::vector<CaseAnswer>& answers) {
  return std::any_of(answers.begin(), answers.end(),
                     [](const CaseAnswer& each) { return !each.completed(); });
}

}  // namespace launchsafe::study::detail
