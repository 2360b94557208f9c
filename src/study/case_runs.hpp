// Runs as tasks, for every kind of study: taken from the store where they are there, kept there where they
// are not.
#pragma once

#include "launchsafe/study/options.hpp"
#include "launchsafe/study/read_study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study::detail {

/// One run that a study needs: the mechanics of a scene, or, with a gap (m), its coupled run.
struct NeededRun {
  const scene::Scene* scene = nullptr;
  std::string label;
  std::optional<double> coupled_gap;
};

/// What is run for it: the scene without all that does not influence the run.
scene::Scene scene_of(const NeededRun& needed);
/// What determines the result: model version, kind of run, and the scene above.
store::CaseIdentity identity_of(const NeededRun& needed);

struct ObtainedRun {
  run::CaseResult result;  ///< no gaps for the mechanics alone
  bool reused = false;     ///< it was stored
};

/// The result from the store, or computed and handed to it. A case that was timed out before under a limit no
/// smaller than today's is not tried again. Throws what the runner throws, after journaling it.
ObtainedRun obtain(const NeededRun& needed, const StudyOptions& options, const Allotment& allotment);

/// Relative cost of a run: predicted particle updates, > 0.
double cost_of(const scene::Scene& scene);
/// Why a run that is not stored must not be begun; empty for one that may.
std::string refusal_of(const NeededRun& needed, const StudyOptions& options);
/// A task for one run, cheap where its result is stored.
Task task_of(const NeededRun& needed, const StudyOptions& options,
             std::function<void(const Allotment&)> work);

/// Journals a run that failed before it began: one that the memory limit refused.
void note_refusal(const NeededRun& needed, const TaskOutcome& outcome, const StudyOptions& options);

Resources resources_of(const StudyOptions& options);

/// Why a run is no basis for a verdict; empty for a completed one.
std::string failure_of(const run::MechanicsResult& mechanics, const TaskOutcome& outcome);

/// Adds one run to a study's cost.
void add_run(Timing& timing, const run::MechanicsResult& mechanics, bool reused, const TaskOutcome& outcome);

/// Which cases of a study with one mechanical run a case belong to a shard.
std::vector<bool> cases_of_shard(const StudyFile& study, const Shard& shard);

/// Cases at a time: what the caller asks for, or all cores.
int jobs_of(const StudyOptions& options);

bool stop_requested(const StudyOptions& options);

}  // namespace launchsafe::study::detail
