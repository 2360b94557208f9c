// What the caller of a study may choose, watch and replace, and how it is divided over processes or machines.
#pragma once

#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/study/scheduler.hpp"

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

}  // namespace launchsafe::study
