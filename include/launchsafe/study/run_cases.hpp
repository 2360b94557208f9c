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
  /// "2-of-4"; empty for the whole.
  std::string part() const;
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
  refused,      ///< it would take more memory or time than allowed
  timed_out,    ///< it took more wall time than allowed, now or before
  interrupted,  ///< the study was stopped before it ended
  failed,       ///< it threw, for want of memory for example
  not_stored    ///< it may not be computed (StudyOptions::compute), and is not stored
};

struct StudyOptions {
  int jobs = 0;             ///< cases at a time; <= 0: available_cores()
  double memory_limit = 0;  ///< bytes of all running cases together; <= 0: most of what is available
  double time_limit = math::infinity;  ///< s of wall time, of one case
  /// s, predicted; a case that takes longer is refused (run::out_of_reach).
  double longest_run = run::Reach{}.longest_run;
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
  double particle_updates = 0;  ///< of all runs
  double run_time = 0;          ///< s, sum of the runs' processor times
  int jobs = 1;                 ///< cases at a time
  double updates_per_second() const { return run_time > 0 ? particle_updates / run_time : 0; }  ///< a core
};

/// One run: the mechanics of a scene, or, with a gap, a coupled run of that gap (run::run_with_skin).
struct CaseRun {
  std::string label;               ///< for people
  scene::Scene scene;              ///< without all that does not influence the run
  std::optional<double> skin_gap;  ///< m
  std::string hash;                ///< of its identity: the name of its file in the store
  double cost = 0;                 ///< predicted particle updates, where they are not those of the scene
  bool checkpoints = false;        ///< the result of the mechanics keeps them, where it is computed
  /// Of a complete run: the mechanics of its launch, from whose checkpoints it goes on; it outlives the run.
  const run::MechanicsResult* launch = nullptr;
  double same_until = 0;  ///< s, of the mechanics of a longer launch: until then it is `launch`
};

CaseRun mechanics_run(const scene::Scene& scene, std::string label);
CaseRun skin_run(const scene::Scene& scene, double gap, std::string label);
/// Predicted particle updates of a run with skin that goes on from a checkpoint of its launch, where its air
/// allows that; otherwise those of the whole run.
double continued_cost(const CaseRun& run);
/// What determines the result of a run: model version, kind of run, and scene.
store::CaseIdentity identity_of(const CaseRun& run);

/// A run of a study that waits: it is made when it is its turn.
struct PlannedRun {
  std::function<CaseRun()> make;
  double cost = 1;  ///< predicted particle updates, > 0: of the run, or of one like it
  /// The case, by its place in the study, whose first run it is: where that is run too, it is run once.
  std::optional<std::size_t> first_run_of = {};
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
  /// The mechanics; then, where the study asks for it, under a raised load, or those of its two
  /// neighbouring_loads, or through the ignition of gaps;
  /// at last, where `Study::in_detail` says so, the longer launch if there is one, which goes on from the
  /// first.
  std::vector<PlannedRun> runs;
  int shard = 1;
};

/// How many of them are not the first run of another case.
std::size_t own_runs(const CaseRuns& runs);

/// A scene with its scene::longer_launch; none where there is none.
std::optional<scene::Scene> with_longer_launch(const scene::Scene& scene);

/// The runs that a study needs before it seeks critical gaps, in the order of their first cases, divided over
/// so many shards. The study has to outlive them. What a run costs is predicted of a few hundred, evenly
/// spread, and taken for those that follow each. `checkpoints`: of the mechanics of every case.
std::vector<CaseRuns> case_runs(const StudyFile& study, int shards, bool checkpoints = false);
std::vector<CaseRuns> case_runs(StudyFile&& study, int shards, bool checkpoints = false) = delete;

/// What became of one run.
struct FinishedRun {
  RunOutcome outcome = RunOutcome::failed;
  std::string failure;     ///< why it is no basis for a verdict; empty for a completed run
  run::CaseResult result;  ///< no gaps for the mechanics alone; empty unless the run began or was stored
  std::string hash;        ///< of its identity, likewise
  bool expected = false;   ///< that it is no basis for a verdict is what the study asks for
  /// Whether there is a result, if perhaps of a run that broke off or ended by itself before its time.
  bool has_result() const;
};

/// The run for want of which a case cannot be judged; nullptr where it can. A case whose first run broke off
/// is judged on that run alone.
const FinishedRun* run_without_result(const std::vector<FinishedRun>& runs);

// --- The launch of a case under the load at the hot end of its assumed spread: one of its own, or, in a
// sweep over the peak pressure that asks for it, interpolated between the launches of its neighbours. ---

/// Whether the uncertainty of the inputs is found by propagating the assumed spread, which takes a run with a
/// raised load beside every case: where verdicts are given and the study states none.
bool propagates_spread(const Study& study);

/// The factors by which neighbouring peak pressures must differ at the least, so that the raised load lies
/// all but between them, and at the most.
inline constexpr double least_load_ratio = 1.036, largest_load_ratio = 1.12;

/// Two cases of a sweep that differ from a third in the peak pressure alone.
struct NeighbouringLoads {
  std::size_t above = 0, beside = 0;  ///< places among the study's cases; `beside` is lower, or above `above`
  double own_peak = 0, above_peak = 0, beside_peak = 0;  ///< Pa
};

/// Of a case whose raised load is to be interpolated and has two neighbours near enough; nothing of others.
std::optional<NeighbouringLoads> neighbouring_loads(const StudyFile& study, std::size_t index);

/// Of the launches of a case and of its two neighbours, which follow it, makes those of the case and of its
/// raised load: linear in the peak pressure between the case and the one above, and hotter by what the same
/// estimate misses the middle one of the three by (trace::at_load). Where a neighbour's launch broke off, so
/// has this one; without a result where it has none.
void interpolate_raised_load(const NeighbouringLoads& loads, std::vector<FinishedRun>& runs);

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

/// Why a run that is not stored must not be begun; empty for one that may.
std::string refusal_of(const scene::Scene& scene, const StudyOptions& options);
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

// --- what a study would do, before it does it: which mechanical runs it needs, which of them are stored,
// what the rest will cost ---

/// One mechanical run, with the cases of the study that share it, or its run with a raised load.
struct ForecastRun {
  std::string label;      ///< of the first of its cases
  std::string hash;       ///< names its file in the store
  std::size_t cases = 0;  ///< 0 for the run with a raised load that belongs to the run before it
  std::int64_t particles = 0, steps = 0;
  double memory = 0;  ///< bytes
  double kept = 0;  ///< bytes of its trace and checkpoints, of which a study in detail has some till its end
  double time = 0;  ///< s on a core, predicted; 0 for one that does not run
  double disk = 0;  ///< bytes of its file, before compression
  int shard = 1;
  bool stored = false;    ///< its result is there
  bool given_up = false;  ///< it was timed out, or failed and may not be computed: that is its row
  bool refused = false;   ///< given up because it is out of reach (run::out_of_reach)
  std::string why;        ///< why it is used again or has to run
};

struct Forecast {
  std::size_t cases = 0;          ///< of the shard asked for
  std::size_t run_count = 0;      ///< mechanical runs of these
  std::vector<ForecastRun> runs;  ///< of them; of many some, evenly spread, from which all else is estimated
  /// Of all runs, what is the case for so many of `runs`.
  std::size_t of_all(std::size_t runs_like_that) const;
  /// Coupled runs that may follow, at most.
  std::size_t confirmations = 0;
  double update_rate = 0;        ///< particle updates per second on a core that the prediction rests on
  std::size_t learned_from = 0;  ///< recorded runs that the rate was learned from; 0: measured now
  double time = 0;               ///< s of wall time, of all that is to run
  double confirmation_time = 0;  ///< s of it, at most, of what follows launches that are to run
  double memory = 0;  ///< bytes at most: as the cases run side by side, or as the report is written
  double disk = 0;    ///< bytes, rather too many, of the files of all that is to run, coupled runs too
  int jobs = 1;
};

/// Why a study is not begun at all: every one of its cases is out of reach. The error of the first.
std::optional<scene::InputError> all_out_of_reach(const StudyFile& study, const run::Reach& reach);

/// The first difference between what determines two cases or studies, "key = value" a line, and how many more
/// there are: "load.peak = 450 MPa here, 496 MPa there and 1 more".
std::string difference_of_inputs(const std::string& here, const std::string& there);

/// `update_rate` (particle updates per second on a core) is used where no recorded run knows better.
/// `most_cases`: of so many the runs are planned.
Forecast forecast_study(const StudyFile& study, const StudyOptions& options, double update_rate,
                        std::size_t most_cases = 1000);

}  // namespace launchsafe::study
