// Mechanical runs as tasks, for every kind of study.
#pragma once

#include "launchsafe/study/options.hpp"
#include "launchsafe/study/read_study.hpp"

#include <string>
#include <vector>

namespace launchsafe::study::detail {

/// Relative cost of a run: predicted particle updates, > 0.
double cost_of(const scene::Scene& scene);

/// What the runner of one task gets.
run::RunOptions run_options(const StudyOptions& options, const std::function<void(double)>& report_share);

/// Why a run is no basis for a verdict; empty for a completed one.
std::string failure_of(const run::MechanicsResult& mechanics, const TaskOutcome& outcome);

/// Adds one run to a study's cost.
void add_run(Timing& timing, const run::MechanicsResult& mechanics, const TaskOutcome& outcome);

/// Cases at a time: what the caller asks for, or all cores.
int jobs_of(const StudyOptions& options);

}  // namespace launchsafe::study::detail
