// The runs that cases need, one loop for every kind of study: taken from the store where they are there,
// computed and kept there where they are not; what the caller may choose, watch and replace, how a study is
// divided over processes or machines, and what it would do.
#pragma once

#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/study/scheduler.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {

/// Part `index` (from 1) of `count`.
struct Shard {
  int index = 1, count = 1;
  bool whole() const { return count == 1; }
};

/// "2/4", with 1 <= index <= count <= 10000; nothing for any other text.
bool parse_shard(std::string_view text, Shard& shard);

/// The shard (from 1) of every case such that the shards' costs are nearly equal: the most costly first, each
/// to the shard with the least so far. Depends on the costs and their order alone.
std::vector<int> shards_of(const std::vector<double>& costs, int count);

/// How mechanics are run. Tests put closed forms in their place.
struct Runners {
  std::function<run::MechanicsResult(const scene::Scene&, const run::RunOptions&)> mechanics =
      run::run_mechanics;
  std::function<run::CaseResult(const scene::Scene&, double gap, const run::RunOptions&)> with_skin =
      run::run_with_skin;
};

/// What became of a run that a study needs.
enum class RunOutcome {
  ran,          ///< it was computed, to its end or to where its computation broke off
  reused,       ///< its stored result was used
  other_shard,  ///< it is no part of the shard that was asked for
  refused,      ///< it would take more memory than allowed
  timed_out,    ///< it took more wall time than allowed, now or before
  interrupted,  ///< the study was stopped before it ended
  failed,       ///< it threw, for want of memory for example
  not_stored    ///< it may not be computed (StudyOptions::compute), and is not stored
};

struct StudyOptions {
  int jobs = 0;             ///< cases at a time; <= 0: available_cores()
  double memory_limit = 0;  ///< bytes of all running cases together; <= 0: most of what is available
  double time_limit = math::infinity;  ///< s of wall time, of one case
  Shard shard;  ///< the part of the mechanical runs that is ours; the others are not run
  /// Set from elsewhere (a signal handler) to stop: running cases end as interrupted, waiting ones do not
  /// start. The study sets it itself when its store can no longer be written.
  std::atomic<bool>* stop = nullptr;
  ProgressCallback progress;
  Runners runners;
  bool compute = true;  ///< false: only what is stored counts
  /// Where results are kept and taken from; none: nothing is kept.
  store::CaseStore* store = nullptr;
};

/// What a study cost.
struct Timing {
  double wall_time = 0;    ///< s, of the whole study
  std::size_t runs = 0;    ///< mechanical runs that were started
  std::size_t reused = 0;  ///< mechanical runs whose stored result, or the answer drawn from it, was used
  int jobs = 1;            ///< cases at a time
};

/// One run: the mechanics of a scene, or, with a gap, a coupled run of that gap (run::run_with_skin).
struct CaseRun {
  std::string label;               ///< for people
  scene::Scene scene;              ///< without all that does not influence the run
  std::optional<double> skin_gap;  ///< m
  std::string hash;                ///< of its identity: the name of its file in the store
};

CaseRun mechanics_run(const scene::Scene& scene, std::string label);
CaseRun skin_run(const scene::Scene& scene, double gap, std::string label);
/// What determines the result of a run: model version, kind of run, and scene.
store::CaseIdentity identity_of(const CaseRun& run);

/// What the launch of a run is to its case.
enum class Part {
  own,
  through_ignition,    ///< of a gap, and on through combustion
  raised,              ///< with the peak pressure at the end of its spread
  companion,           ///< with cells twice or half as large
  cells_of_constants,  ///< with the cells that its constants were fitted on
  model                ///< under other constants
};

/// A run of a study that waits: it is made when it is its turn.
struct PlannedRun {
  std::function<CaseRun()> make;
  double cost = 1;  ///< predicted particle updates, > 0: of the run, or of one like it
  Part part = Part::own;
  std::string name = {};  ///< of the other constants
};
/// Of a run that is there already.
PlannedRun planned_run(CaseRun run);
/// Predicted particle updates, > 0.
double cost_of(const CaseRun& run);
/// Bytes, with the skin of a coupled run.
double memory_of(const CaseRun& run);

/// Runs that are judged together, and the cases of the study that are judged on them.
struct CaseRuns {
  std::vector<std::size_t> members;  ///< of StudyFile::cases; those that differ in thermal keys alone share
  /// The launch itself; then, where the study asks for them, through the ignition of gaps, and those that the
  /// bounds of its critical gap rest on.
  std::vector<PlannedRun> runs;
  int shard = 1;
};

/// The runs that a study needs before it seeks critical gaps, in the order of their first cases, divided over
/// so many shards. The study has to outlive them. What a run costs is predicted of a few hundred, evenly
/// spread, and taken for those that follow each.
std::vector<CaseRuns> case_runs(const StudyFile& study, int shards);
std::vector<CaseRuns> case_runs(StudyFile&& study, int shards) = delete;

/// What became of one run.
struct FinishedRun {
  RunOutcome outcome = RunOutcome::failed;
  std::string failure;     ///< why it is no basis for a verdict; empty for a completed run
  run::CaseResult result;  ///< no gaps for the mechanics alone; empty unless the run began or was stored
  std::string hash;        ///< of its identity, likewise
  bool expected = false;   ///< that it is no basis for a verdict is what the study asks for
  Part part = Part::own;   ///< as PlannedRun has them
  std::string name = {};
  /// Whether there is a result, if perhaps of a run that broke off or ended by itself before its time.
  bool has_result() const;
};

/// The run for want of which a case has no row yet: one of another shard, or one that was not run. nullptr
/// where there is none: a launch that failed is told in the row.
const FinishedRun* run_without_result(const std::vector<FinishedRun>& runs);

/// The finished run of a part, or of a part and other constants; nullptr without one.
const FinishedRun* find_part(const std::vector<FinishedRun>& runs, Part part, const std::string& name = {});

// --- Running. ---

/// Called once for every case, from any thread, with the outcomes of its runs in their order. What it throws
/// makes it called once more, with runs that failed for that reason.
using OnCaseDone = std::function<void(std::size_t index, std::vector<FinishedRun>& runs)>;

/// Runs all cases of the shard that `options` asks for as independent tasks, the most costly run first. A run
/// that fails, is refused or times out is the outcome of its case alone. One that was timed out before under
/// a limit no smaller than today's is not tried again. A second run of a case whose first did not complete is
/// not begun.
void run_cases(const std::vector<CaseRuns>& cases, const StudyOptions& options, ProgressTracker& tracker,
               Timing& timing, const OnCaseDone& on_done);

/// `run_cases` with the runs that all cases of a study need; called for every case rather than once for those
/// that share a run.
void run_every_case(const StudyFile& study, const StudyOptions& options, Timing& timing,
                    const std::function<void(std::size_t member, std::vector<FinishedRun>& runs)>& on_done);

/// `run_cases` with runs that are judged each by itself.
void run_each(std::vector<PlannedRun> runs, const StudyOptions& options, ProgressTracker& tracker,
              Timing& timing, const std::function<void(std::size_t run, const FinishedRun&)>& on_done);

/// Relative cost of a run from the start: predicted particle updates, with all that may follow ignitions; >
/// 0.
double cost_of(const scene::Scene& scene);
/// Why mechanics that ended are no basis for a verdict; empty for completed ones.
std::string failure_of(const run::MechanicsResult& mechanics);
/// Cases at a time: what the caller asks for, or all cores.
int jobs_of(const StudyOptions& options);
bool stop_requested(const StudyOptions& options);

/// The result of a study and what it cost: `compute` runs its cases; `conclude` draws from them what the kind
/// is after, unless the study was interrupted.
template <class Result>
Result run_timed(const StudyFile& study, const StudyOptions& options,
                 const std::function<void(Result&)>& compute,
                 const std::function<void(Result&)>& conclude = {}) {
  const auto start = std::chrono::steady_clock::now();
  Result result;
  result.study = study;
  result.timing.jobs = jobs_of(options);
  compute(result);
  result.interrupted = stop_requested(options);
  if (!result.interrupted && conclude) conclude(result);
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

// --- what a study would cost ---

/// Counted of some cases, evenly spread over a large study.
struct Estimate {
  std::size_t cases = 0;         ///< of the shard asked for
  std::size_t runs = 0;          ///< mechanical runs of these
  std::size_t stored = 0;        ///< of them
  std::size_t coupled_runs = 0;  ///< that may follow, at most
  double updates = 0;            ///< of particles, by all that is to run
  double memory = 0;             ///< bytes of the largest launch
  int jobs = 1;                  ///< runs at a time
  /// s of wall time, at particle updates per second on a core.
  double time(double update_rate) const { return updates / update_rate / jobs; }
};
Estimate estimate_of(const StudyFile& study, const StudyOptions& options);

}  // namespace launchsafe::study
