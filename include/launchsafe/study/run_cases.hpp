// The runs that cases need, one loop for every kind of study: taken from the store where they are there,
// computed and kept there where they are not.
#pragma once

#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {

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

/// Whether a case has launches in which its gaps close, in place of one on which all are judged.
inline bool compares_closing(const Study& study, const StudyCase& input) {
  return input.closing && study.kind.closing_gaps == ClosingGaps::compared;
}

/// Runs that are judged together, and the cases of the study that are judged on them.
struct CaseRuns {
  std::vector<std::size_t> members;  ///< of StudyFile::cases; those that differ in thermal keys alone share
  /// The mechanics; then, where the study asks for it, under a raised load, or those of its two
  /// neighbouring_loads, or through the ignition of gaps;
  /// or, where it compares gaps that close, theirs alone (compares_closing);
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

}  // namespace launchsafe::study
