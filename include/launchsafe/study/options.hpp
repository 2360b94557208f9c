// What the caller of a study may choose, watch and replace.
#pragma once

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/study/scheduler.hpp"

#include <atomic>
#include <functional>

namespace launchsafe::study {

/// How mechanics are run. Tests put closed forms in their place.
struct Runners {
  std::function<run::MechanicsResult(const scene::Scene&, const run::RunOptions&)> mechanics;
  std::function<run::CaseResult(const scene::Scene&, double gap, const run::RunOptions&)> coupled;
};
/// run::run_mechanics and run::run_coupled.
Runners simulation_runners();

struct StudyOptions {
  int jobs = 0;  ///< cases at a time; <= 0: available_cores()
  /// Set from elsewhere (a signal handler) to stop: running cases end as interrupted, waiting ones do not
  /// start.
  const std::atomic<bool>* stop = nullptr;
  ProgressCallback progress;
  Runners runners = simulation_runners();
};

/// What a study cost.
struct Timing {
  double wall_time = 0;         ///< s, of the whole study
  std::size_t runs = 0;         ///< mechanical runs that were started
  double particle_updates = 0;  ///< of all runs
  double run_time = 0;          ///< s, sum of the runs' wall times
  int jobs = 1;                 ///< cases at a time
  double updates_per_second() const { return run_time > 0 ? particle_updates / run_time : 0; }  ///< a core
};

}  // namespace launchsafe::study
