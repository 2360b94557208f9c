#include "case_runs.hpp"

#include "launchsafe/scene/plan.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::study {

Runners simulation_runners() { return {run::run_mechanics, run::run_coupled}; }

namespace detail {

double cost_of(const scene::Scene& scene) {
  const scene::Plan plan = scene::make_plan(scene);
  const double cost = static_cast<double>(plan.steps) * static_cast<double>(plan.particles());
  return std::isfinite(cost) ? std::max(cost, 1.0) : 1.0;
}

run::RunOptions run_options(const StudyOptions& options, const std::function<void(double)>& report_share) {
  return {options.stop, report_share};
}

std::string failure_of(const run::MechanicsResult& mechanics, const TaskOutcome& outcome) {
  if (!outcome.started) return "not run: the study was interrupted before";
  if (!outcome.failure.empty()) return "the run failed: " + outcome.failure;
  if (mechanics.status == run::RunStatus::completed) return {};
  return run::to_string(mechanics.status) + (mechanics.reason.empty() ? "" : ": " + mechanics.reason);
}

void add_run(Timing& timing, const run::MechanicsResult& mechanics, const TaskOutcome& outcome) {
  if (!outcome.started) return;
  ++timing.runs;
  timing.particle_updates += static_cast<double>(mechanics.steps) * static_cast<double>(mechanics.particles);
  timing.run_time += mechanics.wall_time;
}

int jobs_of(const StudyOptions& options) { return options.jobs > 0 ? options.jobs : available_cores(); }

}  // namespace detail
}  // namespace launchsafe::study
