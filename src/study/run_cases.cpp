#include "launchsafe/study/run_cases.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/mechanical_part.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/changed_scene.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace launchsafe::study {
namespace {

using store::CaseState, store::RunRecord;

FinishedRun without_result(RunOutcome outcome, std::string failure) {
  return {outcome, std::move(failure), {}, {}};
}

/// Of a result that was just computed, or of one that is stored.
FinishedRun with_result(run::CaseResult result, RunOutcome outcome) {
  FinishedRun run{outcome, failure_of(result.mechanics), std::move(result), {}};
  if (run.result.mechanics.status == run::RunStatus::timed_out) run.outcome = RunOutcome::timed_out;
  if (run.result.mechanics.status == run::RunStatus::interrupted) run.outcome = RunOutcome::interrupted;
  return run;
}

RunRecord entry_for(const CaseRun& run, CaseState state, std::string reason) {
  RunRecord entry;
  entry.hash = run.hash;
  entry.state = state;
  entry.label = run.label;
  entry.reason = std::move(reason);
  entry.model_version = run::model_version;
  entry.predicted_updates = cost_of(run);
  return entry;
}

/// The runs of all cases as tasks; a case is judged by the thread that ends the last of its runs.
class CaseLoop {
 public:
  CaseLoop(const std::vector<CaseRuns>& cases, const StudyOptions& options, ProgressTracker& tracker,
           Timing& timing, const OnCaseDone& on_done)
      : cases_(cases),
        options_(options),
        tracker_(tracker),
        timing_(timing),
        on_done_(on_done),
        open_(cases.size()) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      open_[i].runs.resize(cases[i].runs.size());
      open_[i].left = cases[i].runs.size();
    }
  }

  void run() {
    std::vector<WaitingTask> tasks;
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (cases_[i].shard != options_.shard.index) {
        give_up(i, RunOutcome::other_shard, "not run: it belongs to another shard");
        continue;
      }
      for (std::size_t j = 0; j < cases_[i].runs.size(); ++j) {
        tasks.push_back({cases_[i].runs[j].cost, [this, i, j] { return task_of(i, j); }});
        places.emplace_back(i, j);
        tracker_.expect(1, tasks.back().cost);
      }
    }
    const auto outcomes = run_tasks(tasks, {options_.jobs, options_.memory_limit}, tracker_, options_.stop);
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      const auto [i, j] = places[task];
      if (outcomes[task].refused) {
        note_refusal(cases_[i].runs[j].make(), outcomes[task].failure);
        finish(i, j, without_result(RunOutcome::refused, "the run failed: " + outcomes[task].failure));
      } else if (!outcomes[task].started) {
        finish(i, j, without_result(RunOutcome::interrupted, "not run: the study was interrupted before"));
      }
    }
  }

 private:
  struct OpenCase {
    std::vector<FinishedRun> runs;
    std::atomic<std::size_t> left{0};
    std::atomic<bool> spoilt{false};  ///< the first of them did not complete
  };

  /// Cheap where the result is stored.
  Task task_of(std::size_t i, std::size_t j) {
    constexpr double reading_share = 1e-3;
    const auto run = std::make_shared<const CaseRun>(cases_[i].runs[j].make());
    const auto work = [this, i, j, run](const Allotment& allotment) {
      finish(i, j, perform(i, *run, allotment));
    };
    if (options_.store != nullptr && options_.store->holds(run->hash))
      return {reading_share * cost_of(*run), work, 0.0, {}};
    if (std::string refusal = refusal_of(run->scene, options_); !refusal.empty())
      return {1.0, work, 0.0, std::move(refusal)};
    return {cost_of(*run), work, run::cost_of(run->scene).memory(), {}};
  }

  FinishedRun perform(std::size_t i, const CaseRun& run, const Allotment& allotment) {
    if (open_[i].spoilt)
      return without_result(RunOutcome::interrupted, "not run: the first run of its case did not complete");
    FinishedRun finished = load_or_compute(run, allotment);
    finished.hash = run.hash;
    count(finished);
    return finished;
  }

  FinishedRun load_or_compute(const CaseRun& run, const Allotment& allotment) {
    try {
      if (options_.store == nullptr) return with_result(compute(run, allotment), RunOutcome::ran);
      if (options_.store->holds(run.hash)) {
        if (auto stored = options_.store->load(run.hash))
          return with_result(std::move(*stored), RunOutcome::reused);
      }
      const auto before = options_.store->record_of(run.hash);
      if (before && before->state == CaseState::timed_out &&
          (!options_.compute || options_.time_limit <= before->time_limit)) {
        run::CaseResult result;
        result.mechanics.status = run::RunStatus::timed_out;
        result.mechanics.reason = before->reason;
        return with_result(std::move(result), RunOutcome::timed_out);
      }
      if (!options_.compute) {
        if (before && before->state == CaseState::failed)
          return without_result(RunOutcome::failed, "the run failed: " + before->reason);
        return without_result(RunOutcome::not_stored, "the run failed: it is not stored");
      }
      FinishedRun computed = with_result(compute(run, allotment), RunOutcome::ran);
      keep(run, computed);
      return computed;
    } catch (const std::exception& error) {
      if (options_.store != nullptr && options_.compute)
        options_.store->note(entry_for(run, CaseState::failed, error.what()));
      return without_result(RunOutcome::failed, fmt::format("the run failed: {}", error.what()));
    } catch (...) {
      return without_result(RunOutcome::failed, "the run failed: an unknown exception");
    }
  }

  run::CaseResult compute(const CaseRun& run, const Allotment& allotment) const {
    const run::RunOptions run_options{options_.stop,     options_.time_limit, allotment.report_share,
                                      allotment.threads, run.checkpoints,     run.launch};
    if (run.skin_gap) return options_.runners.with_skin(run.scene, *run.skin_gap, run_options);
    run::CaseResult result;
    result.mechanics = options_.runners.mechanics(run.scene, run_options);
    return result;
  }

  void keep(const CaseRun& run, const FinishedRun& computed) {
    const run::MechanicsResult& mechanics = computed.result.mechanics;
    CaseState state = CaseState::done;
    if (computed.outcome == RunOutcome::interrupted) state = CaseState::interrupted;
    if (computed.outcome == RunOutcome::timed_out) state = CaseState::timed_out;
    RunRecord entry = entry_for(run, state, state == CaseState::done ? std::string{} : mechanics.reason);
    entry.wall_time = mechanics.wall_time;
    entry.processor_time = mechanics.processor_time;
    if (state == CaseState::timed_out) entry.time_limit = options_.time_limit;
    if (state == CaseState::done)
      options_.store->save(identity_of(run), run.scene, computed.result, std::move(entry));
    else
      options_.store->note(std::move(entry));
  }

  /// Once: a study that is started again and again refuses the same run each time.
  void note_refusal(const CaseRun& run, const std::string& reason) {
    if (options_.store == nullptr || !options_.compute) return;
    const auto before = options_.store->record_of(run.hash);
    if (before && before->state == CaseState::failed && before->reason == reason) return;
    options_.store->note(entry_for(run, CaseState::failed, reason));
  }

  void count(const FinishedRun& run) {
    const run::MechanicsResult& mechanics = run.result.mechanics;
    const bool computed = run.outcome == RunOutcome::ran || mechanics.steps > 0;
    const std::lock_guard lock(mutex_);
    if (run.outcome == RunOutcome::reused) {
      ++timing_.reused;
    } else if (run.has_result() && computed) {
      ++timing_.runs;
      timing_.particle_updates += mechanics.particle_updates();
      timing_.run_time += mechanics.wall_time;
    }
  }

  void finish(std::size_t i, std::size_t j, FinishedRun run) {
    OpenCase& open = open_[i];
    if (j == 0 && !run.failure.empty()) open.spoilt = true;
    open.runs[j] = std::move(run);
    if (--open.left > 0) return;
    std::optional<std::string> failure;
    try {
      on_done_(i, open.runs);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    if (failure) give_up(i, RunOutcome::failed, "the run failed: " + *failure);
    open.runs.clear();
  }

  void give_up(std::size_t i, RunOutcome outcome, const std::string& failure) {
    for (FinishedRun& each : open_[i].runs) each = without_result(outcome, failure);
    on_done_(i, open_[i].runs);
  }

  const std::vector<CaseRuns>& cases_;
  const StudyOptions& options_;
  ProgressTracker& tracker_;
  Timing& timing_;
  const OnCaseDone& on_done_;
  std::vector<OpenCase> open_;
  std::mutex mutex_;
};

double scheduled(double work) { return std::isfinite(work) ? std::max(work, 1.0) : 1.0; }

CaseRun planned(scene::Scene scene, std::optional<double> gap, std::string label) {
  CaseRun run{std::move(label), std::move(scene), gap, {}};
  run.hash = identity_of(run).hash();
  return run;
}

}  // namespace

PlannedRun planned_run(CaseRun run) {
  const double cost = cost_of(run);
  return {[run = std::move(run)] { return run; }, cost};
}

double cost_of(const CaseRun& run) { return run.cost > 0.0 ? run.cost : cost_of(run.scene); }

Runners simulation_runners() { return {run::run_mechanics, run::run_with_skin}; }

CaseRun mechanics_run(const scene::Scene& scene, std::string label) {
  return planned(scene::mechanical_part(scene), std::nullopt, std::move(label));
}

CaseRun skin_run(const scene::Scene& scene, double gap, std::string label) {
  scene::Scene own = scene;
  scene::clear_remarks(own);
  own.accepted.clear();
  own.surface.gaps = {gap};
  if (own.surface.air_model == scene::AirModel::reservoir) own.coupling = scene::Coupling::two_way;
  return planned(std::move(own), gap, std::move(label));
}

double continued_cost(const CaseRun& run) {
  const run::Cost cost = run::cost_of(run.scene);
  return scheduled(cost.coupled > 0.0 ? cost.coupled : cost.work);
}

store::CaseIdentity identity_of(const CaseRun& run) {
  return store::CaseIdentity(fmt::format("# model version {}, {}\n{}", run::model_version,
                                         run.skin_gap ? "coupled run" : "mechanics",
                                         scene::to_toml(run.scene)));
}

bool FinishedRun::has_result() const {
  return outcome == RunOutcome::ran || outcome == RunOutcome::reused || outcome == RunOutcome::timed_out ||
         (outcome == RunOutcome::interrupted && result.mechanics.status == run::RunStatus::interrupted);
}

const FinishedRun* run_without_result(const std::vector<FinishedRun>& runs) {
  for (const FinishedRun& run : runs) {
    if (!run.has_result()) return &run;
    if (!run.failure.empty()) return nullptr;
  }
  return nullptr;
}

namespace {

/// The gaps of a case that are run through ignition; none with one-way coupling, or where the kind does not
/// ask for them.
std::vector<double> burning_gaps(const StudyFile& study, const StudyCase& input) {
  const scene::Scene& scene = input.scene.scene;
  if (!study.study.kind.goes_through_ignition || scene.coupling == scene::Coupling::one_way) return {};
  return scene.surface.gaps;
}

/// Of so many cases at the most the runs are planned before they are begun.
constexpr std::size_t most_planned_before = 512;

}  // namespace

std::optional<scene::Scene> with_longer_launch(const scene::Scene& scene) {
  std::optional<scene::Load> longer = scene::longer_launch(scene.load);
  if (!longer) return std::nullopt;
  scene::Scene other = scene;
  other.load = std::move(*longer);
  return other;
}

namespace {

/// The axes that reach the mechanics.
std::vector<std::size_t> mechanical_axes(const std::vector<Axis>& axes) {
  std::vector<std::size_t> reaching;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (keys::reaches_mechanics(axes[i].key.role().acts_on)) reaching.push_back(i);
  return reaching;
}

/// Whether the mechanics of a case has its values of these axes: not where a launch decides whether the
/// mechanics knows a key, as its role says, or as its value is not there.
bool keeps_values(const StudyFile& study, std::size_t index, const std::vector<std::size_t>& axes) {
  const scene::Scene part = scene::mechanical_part(study.cases[index].scene.scene);
  return std::ranges::all_of(axes, [&](std::size_t i) {
    const Axis& axis = study.study.axes[i];
    const keys::ActsOn acts_on = axis.key.role().acts_on;
    const auto* key = scene::find_key(scene::scene_keys(), axis.key.name);
    return (acts_on == keys::ActsOn::mechanics || acts_on == keys::ActsOn::numerics) && key != nullptr &&
           same_value(key->get(part), scene::Value(study.cases.coordinates(index)[i]));
  });
}

/// Whether cases that differ in these axes surely differ in their runs. The first and the last case have
/// other values of each, of which one is not the default.
bool tell_runs_apart(const StudyFile& study, const std::vector<std::size_t>& axes) {
  if (study.cases.empty() || study.study.kind.goes_through_ignition) return false;
  const std::size_t last = study.cases.size() - 1;
  return !study.cases.has_own_scene(0) && !study.cases.has_own_scene(last) && keeps_values(study, 0, axes) &&
         keeps_values(study, last, axes);
}

std::string key_by_values(const std::vector<double>& coordinates, const std::vector<std::size_t>& axes) {
  std::string key;
  for (const std::size_t i : axes) key += fmt::format("{} ", coordinates[i]);
  return key;
}

std::string key_by_runs(const StudyFile& study, const StudyCase& input) {
  std::string key = mechanics_run(input.scene.scene, {}).hash;
  // A case that burns shares its launch alone with no other.
  for (const double gap : burning_gaps(study, input)) key += skin_run(input.scene.scene, gap, {}).hash;
  return key;
}

/// The cases that share runs, in the order of their first ones.
std::vector<CaseRuns> cases_by_runs(const StudyFile& study) {
  std::vector<std::string> keys(study.cases.size());
  const std::vector<std::size_t> axes = mechanical_axes(study.study.axes);
  const bool by_values = tell_runs_apart(study, axes);
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
    const bool varied = by_values && !study.cases.has_own_scene(i);
    keys[i] = varied ? key_by_values(study.cases.coordinates(i), axes) : key_by_runs(study, study.cases[i]);
  });
  std::vector<CaseRuns> cases;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [found, is_new] = known.try_emplace(std::move(keys[i]), cases.size());
    if (is_new) cases.emplace_back();
    cases[found->second].members.push_back(i);
  }
  return cases;
}

/// The run of the mechanics of a case, of its longer launch if there is one.
CaseRun longer_run(const StudyCase& input) {
  return mechanics_run(*with_longer_launch(input.scene.scene),
                       fmt::format("{}, {}", input.label,
                                   scene::is_cut_short(input.scene.scene.load) ? "until the launch is over"
                                                                               : "without muzzle exit"));
}

/// The runs of the first of the cases that share them.
void plan_runs(const StudyFile& study, bool checkpoints, CaseRuns& cases) {
  const std::size_t first = cases.members.front();
  const StudyFile* of = &study;
  cases.runs.push_back({[of, first, checkpoints] {
    const StudyCase input = of->cases[first];
    CaseRun run = mechanics_run(input.scene.scene, input.label);
    run.checkpoints = checkpoints;
    return run;
  }});
  if (study.study.kind.goes_through_ignition)
    for (const double gap : burning_gaps(study, study.cases[first]))
      cases.runs.push_back({[of, first, gap] {
        const StudyCase input = of->cases[first];
        return skin_run(input.scene.scene, gap,
                        fmt::format("{}, through ignition at {:.6g} cm", input.label, 100.0 * gap));
      }});
  if (propagates_spread(study.study))
    cases.runs.push_back({[of, first] {
      const StudyCase input = of->cases[first];
      return mechanics_run(with_raised_load(input.scene.scene), label_of_raised(input));
    }});
  if (study.in_detail && with_longer_launch(study.cases[first].scene.scene))
    cases.runs.push_back({[of, first] { return longer_run(of->cases[first]); }});
}

void predict_costs(std::vector<CaseRuns>& cases) {
  const std::size_t every = (cases.size() + most_planned_before - 1) / most_planned_before;
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    if (i % every != 0) return;
    for (PlannedRun& run : cases[i].runs) run.cost = cost_of(run.make());
  });
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t j = 0; j < cases[i].runs.size(); ++j) {
      const std::vector<PlannedRun>& alike = cases[i - i % every].runs;
      cases[i].runs[j].cost = alike[std::min(j, alike.size() - 1)].cost;
    }
}

}  // namespace

std::vector<CaseRuns> case_runs(const StudyFile& study, int shards, bool checkpoints) {
  std::vector<CaseRuns> cases = cases_by_runs(study);
  for (CaseRuns& each : cases) plan_runs(study, checkpoints, each);
  predict_costs(cases);
  std::vector<double> costs;
  for (const CaseRuns& each : cases) costs.push_back(each.runs.front().cost);
  const std::vector<int> shard = shards_of(costs, shards);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].shard = shard[i];
  return cases;
}

void run_cases(const std::vector<CaseRuns>& cases, const StudyOptions& options, ProgressTracker& tracker,
               Timing& timing, const OnCaseDone& on_done) {
  CaseLoop(cases, options, tracker, timing, on_done).run();
}

std::string refusal_of(const scene::Scene& scene, const StudyOptions& options) {
  if (!options.compute) return {};
  const auto error = run::out_of_reach(scene, {.longest_run = options.longest_run});
  return error ? error->message() : std::string{};
}

double cost_of(const scene::Scene& scene) {
  const run::Cost cost = run::cost_of(scene);
  return scheduled(cost.work + cost.coupled);
}

std::string failure_of(const run::MechanicsResult& mechanics) {
  if (mechanics.status == run::RunStatus::completed) return {};
  return run::to_string(mechanics.status) + (mechanics.reason.empty() ? "" : ": " + mechanics.reason);
}

int jobs_of(const StudyOptions& options) { return options.jobs > 0 ? options.jobs : available_cores(); }

bool stop_requested(const StudyOptions& options) { return options.stop != nullptr && options.stop->load(); }

void run_every_case(const StudyFile& study, const StudyOptions& options, Timing& timing,
                    const std::function<void(std::size_t, std::vector<FinishedRun>&)>& on_done) {
  ProgressTracker tracker(options.progress);
  const std::vector<CaseRuns> runs = case_runs(study, options.shard.count);
  run_cases(runs, options, tracker, timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    for (const std::size_t member : runs[i].members) on_done(member, finished);
  });
}

}  // namespace launchsafe::study
