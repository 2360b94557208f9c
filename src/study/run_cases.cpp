#include "launchsafe/study/run_cases.hpp"

#include "launchsafe/scene/plan.hpp"

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
  return entry;
}

/// The runs of all cases as tasks; a case is judged by the thread that ends the last of its runs.
struct CaseLoop {
  struct OpenCase {
    std::vector<FinishedRun> runs = {};
    std::atomic<std::size_t> left = 0;
    std::atomic<bool> spoilt = false;  ///< the first of them did not complete
  };

  const std::vector<CaseRuns>& cases;
  const StudyOptions& options;
  ProgressTracker& tracker;
  Timing& timing;
  const OnCaseDone& on_done;
  std::vector<OpenCase> open_cases = std::vector<OpenCase>(cases.size());
  std::mutex mutex = {};

  void run() {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      open_cases[i].runs.resize(cases[i].runs.size());
      open_cases[i].left = cases[i].runs.size();
      if (cases[i].shard == options.shard.index) tracker.expect_cases(cases[i].members.size());
    }
    std::vector<WaitingTask> tasks;
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].shard != options.shard.index) {
        give_up(i, RunOutcome::other_shard, "not run: it belongs to another shard");
        continue;
      }
      for (std::size_t j = 0; j < cases[i].runs.size(); ++j) {
        tasks.push_back({cases[i].runs[j].cost, [this, i, j] { return task_of(i, j); }});
        places.emplace_back(i, j);
        tracker.expect(1, tasks.back().cost);
      }
    }
    const auto outcomes = run_tasks(tasks, {options.jobs, options.memory_limit}, tracker, options.stop);
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      const auto [i, j] = places[task];
      if (outcomes[task].refused) {
        note_refusal(cases[i].runs[j].make(), outcomes[task].failure);
        finish(i, j, without_result(RunOutcome::refused, "the run failed: " + outcomes[task].failure));
      } else if (!outcomes[task].started) {
        finish(i, j, without_result(RunOutcome::interrupted, "not run: the study was interrupted before"));
      }
    }
  }

  /// Cheap where the result is stored.
  Task task_of(std::size_t i, std::size_t j) {
    constexpr double reading_share = 1e-3;
    const auto run = std::make_shared<const CaseRun>(cases[i].runs[j].make());
    const auto work = [this, i, j, run](const ReportShare& report) {
      finish(i, j, perform(i, *run, report));
    };
    if (options.store != nullptr && options.store->holds(run->hash))
      return {reading_share * cost_of(*run), work};
    return {cost_of(*run), work, memory_of(*run)};
  }

  FinishedRun perform(std::size_t i, const CaseRun& run, const ReportShare& report) {
    if (open_cases[i].spoilt)
      return without_result(RunOutcome::interrupted, "not run: the first run of its case did not complete");
    FinishedRun finished = load_or_compute(run, report);
    finished.hash = run.hash;
    count(finished);
    return finished;
  }

  FinishedRun load_or_compute(const CaseRun& run, const ReportShare& report) {
    try {
      if (options.store == nullptr) return with_result(compute(run, report), RunOutcome::ran);
      if (options.store->holds(run.hash)) {
        if (auto stored = options.store->load(run.hash))
          return with_result(std::move(*stored), RunOutcome::reused);
      }
      const auto before = options.store->record_of(run.hash);
      if (before && before->state == CaseState::timed_out &&
          (!options.compute || options.time_limit <= before->time_limit)) {
        run::CaseResult result;
        result.mechanics.status = run::RunStatus::timed_out;
        result.mechanics.reason = before->reason;
        return with_result(std::move(result), RunOutcome::timed_out);
      }
      if (!options.compute) {
        if (before && before->state == CaseState::failed)
          return without_result(RunOutcome::failed, "the run failed: " + before->reason);
        return without_result(RunOutcome::not_stored, "the run failed: it is not stored");
      }
      FinishedRun computed = with_result(compute(run, report), RunOutcome::ran);
      keep(run, computed);
      return computed;
    } catch (const std::exception& error) {
      if (options.store != nullptr && options.compute)
        options.store->note(entry_for(run, CaseState::failed, error.what()));
      return without_result(RunOutcome::failed, fmt::format("the run failed: {}", error.what()));
    } catch (...) {
      return without_result(RunOutcome::failed, "the run failed: an unknown exception");
    }
  }

  run::CaseResult compute(const CaseRun& run, const ReportShare& report) const {
    const run::RunOptions run_options{options.stop, options.time_limit, report};
    if (run.skin_gap) return options.runners.with_skin(run.scene, *run.skin_gap, run_options);
    run::CaseResult result;
    result.mechanics = options.runners.mechanics(run.scene, run_options);
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
    if (state == CaseState::timed_out) entry.time_limit = options.time_limit;
    if (state == CaseState::done)
      options.store->save(identity_of(run), computed.result, std::move(entry));
    else
      options.store->note(std::move(entry));
  }

  void note_refusal(const CaseRun& run, const std::string& reason) {
    if (options.store == nullptr || !options.compute) return;
    options.store->note(entry_for(run, CaseState::failed, reason));
  }

  void count(const FinishedRun& run) {
    const run::MechanicsResult& mechanics = run.result.mechanics;
    const bool computed = run.outcome == RunOutcome::ran || mechanics.steps > 0;
    const std::lock_guard lock(mutex);
    if (run.outcome == RunOutcome::reused) {
      ++timing.reused;
    } else if (run.has_result() && computed) {
      ++timing.runs;
    }
  }

  void finish(std::size_t i, std::size_t j, FinishedRun run) {
    OpenCase& open = open_cases[i];
    if (j == 0) open.spoilt = !run.failure.empty();
    open.runs[j] = std::move(run);
    open.runs[j].part = cases[i].runs[j].part;
    open.runs[j].name = cases[i].runs[j].name;
    if (--open.left > 0) return;
    const FinishedRun* lacking = run_without_result(open.runs);
    const FinishedRun& decisive = lacking != nullptr ? *lacking : open.runs.front();
    std::string reason;
    try {
      on_done(i, open.runs);
      if (!decisive.expected) reason = decisive.failure;
    } catch (const std::exception& error) {
      reason = fmt::format("the run failed: {}", error.what());
      give_up(i, RunOutcome::failed, reason);
    }
    const bool ended = decisive.outcome != RunOutcome::interrupted;
    open.runs.clear();
    if (ended) tracker.cases_ended(std::ssize(cases[i].members), !reason.empty());
  }

  void give_up(std::size_t i, RunOutcome outcome, const std::string& failure) {
    for (FinishedRun& each : open_cases[i].runs) each = without_result(outcome, failure);
    on_done(i, open_cases[i].runs);
  }
};

double scheduled(double work) { return std::isfinite(work) ? std::max(work, 1.0) : 1.0; }

CaseRun planned(scene::Scene scene, std::optional<double> gap, std::string label) {
  CaseRun run{std::move(label), std::move(scene), gap, {}};
  run.hash = identity_of(run).hash;
  return run;
}

}  // namespace

PlannedRun planned_run(CaseRun run) {
  const double cost = cost_of(run);
  return {[run = std::move(run)] { return run; }, cost};
}

double cost_of(const CaseRun& run) { return cost_of(run.scene); }

double memory_of(const CaseRun& run) {
  const run::Cost cost = run::cost_of(run.scene);
  return cost.memory() + (run.skin_gap ? cost.skins : 0.0);
}

CaseRun mechanics_run(const scene::Scene& scene, std::string label) {
  return planned(scene::mechanical_part(scene), std::nullopt, std::move(label));
}

CaseRun skin_run(const scene::Scene& scene, double gap, std::string label) {
  scene::Scene own = scene;
  scene::clear_remarks(own);
  own.surface.gaps = {gap};
  own.coupling = scene::Coupling::two_way;
  return planned(std::move(own), gap, std::move(label));
}

store::CaseIdentity identity_of(const CaseRun& run) {
  const char* kind = run.skin_gap ? "coupled run" : "mechanics";
  return store::CaseIdentity(
      fmt::format("# model version {}, {}\n{}", run::model_version, kind, scene::to_toml(run.scene)));
}

bool FinishedRun::has_result() const {
  return outcome == RunOutcome::ran || outcome == RunOutcome::reused || outcome == RunOutcome::timed_out ||
         (outcome == RunOutcome::interrupted && result.mechanics.status == run::RunStatus::interrupted);
}

const FinishedRun* run_without_result(const std::vector<FinishedRun>& runs) {
  for (const FinishedRun& run : runs) {
    const bool is_beside = run.part != Part::own && run.part != Part::through_ignition;
    const bool failed = run.outcome == RunOutcome::failed || run.outcome == RunOutcome::refused;
    if (!run.has_result() && !(is_beside && failed)) return &run;
    // A case whose launch broke off is told by that launch alone.
    if (run.part == Part::own && !run.failure.empty()) return nullptr;
  }
  return nullptr;
}

const FinishedRun* find_part(const std::vector<FinishedRun>& runs, Part part, const std::string& name) {
  const auto found = std::ranges::find_if(
      runs, [&](const FinishedRun& run) { return run.part == part && run.name == name; });
  return found == runs.end() ? nullptr : &*found;
}

void run_cases(const std::vector<CaseRuns>& cases, const StudyOptions& options, ProgressTracker& tracker,
               Timing& timing, const OnCaseDone& on_done) {
  CaseLoop{cases, options, tracker, timing, on_done}.run();
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

void run_each(std::vector<PlannedRun> runs, const StudyOptions& options, ProgressTracker& tracker,
              Timing& timing, const std::function<void(std::size_t, const FinishedRun&)>& on_done) {
  std::vector<CaseRuns> cases;
  for (PlannedRun& each : runs) cases.push_back({{}, {std::move(each)}, options.shard.index});
  run_cases(cases, options, tracker, timing,
            [&](std::size_t i, std::vector<FinishedRun>& finished) { on_done(i, finished.front()); });
}

void run_every_case(const StudyFile& study, const StudyOptions& options, Timing& timing,
                    const std::function<void(std::size_t, std::vector<FinishedRun>&)>& on_done) {
  ProgressTracker tracker(options.progress);
  const std::vector<CaseRuns> runs = case_runs(study, options.shard.count);
  run_cases(runs, options, tracker, timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    for (const std::size_t member : runs[i].members) on_done(member, finished);
  });
}

}  // namespace launchsafe::study
