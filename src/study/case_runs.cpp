#include "case_runs.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/scene/mechanical_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {

Runners simulation_runners() { return {run::run_mechanics, run::run_with_skin}; }

namespace detail {
namespace {

run::CaseResult compute(const NeededRun& needed, const StudyOptions& options, const Allotment& allotment) {
  const scene::Scene scene = scene_of(needed);
  const run::RunOptions run_options{options.stop, options.time_limit, allotment.report_share,
                                    allotment.threads};
  if (needed.coupled_gap) return options.runners.coupled(scene, *needed.coupled_gap, run_options);
  run::CaseResult result;
  result.mechanics = options.runners.mechanics(scene, run_options);
  return result;
}

store::JournalEntry entry_for(const NeededRun& needed, const store::CaseIdentity& identity) {
  store::JournalEntry entry;
  entry.hash = identity.hash();
  entry.label = needed.label;
  entry.model_version = run::model_version;
  entry.predicted_updates = cost_of(*needed.scene);
  return entry;
}

void keep(const NeededRun& needed, const store::CaseIdentity& identity, const run::CaseResult& result,
          const StudyOptions& options) {
  store::JournalEntry entry = entry_for(needed, identity);
  entry.wall_time = result.mechanics.wall_time;
  entry.processor_time = result.mechanics.processor_time;
  switch (result.mechanics.status) {
    case run::RunStatus::interrupted:
      entry.state = store::CaseState::interrupted;
      break;
    case run::RunStatus::timed_out:
      entry.state = store::CaseState::timed_out;
      entry.time_limit = options.time_limit;
      break;
    default:
      return options.store->save(identity, scene_of(needed), result, std::move(entry));
  }
  entry.reason = result.mechanics.reason;
  options.store->note(std::move(entry));
}

/// A result that says that the time limit stopped it before, and would again.
std::optional<run::CaseResult> timed_out_before(const store::CaseIdentity& identity,
                                                const StudyOptions& options) {
  const auto entry = options.store->last_entry(identity.hash());
  if (!entry || entry->state != store::CaseState::timed_out) return std::nullopt;
  if (options.compute && !(options.time_limit <= entry->time_limit)) return std::nullopt;
  run::CaseResult result;
  result.mechanics.status = run::RunStatus::timed_out;
  result.mechanics.reason = entry->reason;
  return result;
}

/// For a case that may not be computed: what the journal says of it.
[[noreturn]] void throw_failure_of(const store::CaseIdentity& identity, const StudyOptions& options) {
  const auto entry = options.store->last_entry(identity.hash());
  if (entry && entry->state == store::CaseState::failed) throw std::runtime_error(entry->reason);
  throw NotStored();
}

}  // namespace

scene::Scene scene_of(const NeededRun& needed) {
  if (!needed.coupled_gap) return scene::mechanical_part(*needed.scene);
  scene::Scene scene = *needed.scene;
  scene.title.clear();
  scene.accepted.clear();
  scene.surface.gaps = {*needed.coupled_gap};
  return scene;
}

store::CaseIdentity identity_of(const NeededRun& needed) {
  return store::CaseIdentity(fmt::format("# model version {}, {}\n{}", run::model_version,
                                         needed.coupled_gap ? "coupled run" : "mechanics",
                                         scene::to_toml(scene_of(needed))));
}

ObtainedRun obtain(const NeededRun& needed, const StudyOptions& options, const Allotment& allotment) {
  if (options.store == nullptr) return {compute(needed, options, allotment), false};
  const store::CaseIdentity identity = identity_of(needed);
  if (options.store->holds(identity.hash())) {
    if (auto stored = options.store->load(identity.hash())) return {std::move(*stored), true};
  }
  if (auto before = timed_out_before(identity, options)) return {std::move(*before), true};
  if (!options.compute) throw_failure_of(identity, options);
  try {
    ObtainedRun run{compute(needed, options, allotment), false};
    keep(needed, identity, run.result, options);
    return run;
  } catch (const std::exception& error) {
    store::JournalEntry entry = entry_for(needed, identity);
    entry.state = store::CaseState::failed;
    entry.reason = error.what();
    options.store->note(std::move(entry));
    throw;
  }
}

double cost_of(const scene::Scene& scene) {
  const double cost = run::cost_of(scene).work;
  return std::isfinite(cost) ? std::max(cost, 1.0) : 1.0;
}

std::string refusal_of(const NeededRun& needed, const StudyOptions& options) {
  if (!options.compute) return {};
  const auto error = run::out_of_reach(*needed.scene, {.longest_run = options.longest_run});
  return error ? error->message() : std::string{};
}

Task task_of(const NeededRun& needed, const StudyOptions& options,
             std::function<void(const Allotment&)> work) {
  constexpr double reading_share = 1e-3;
  const bool stored = options.store != nullptr && options.store->holds(identity_of(needed).hash());
  const double cost = cost_of(*needed.scene);
  if (stored) return {reading_share * cost, std::move(work), 0.0, {}};
  if (std::string refusal = refusal_of(needed, options); !refusal.empty())
    return {1.0, std::move(work), 0.0, std::move(refusal)};
  return {cost, std::move(work), run::cost_of(*needed.scene).memory(), {}};
}

void note_refusal(const NeededRun& needed, const TaskOutcome& outcome, const StudyOptions& options) {
  if (options.store == nullptr || !options.compute || !outcome.started || outcome.failure.empty()) return;
  const store::CaseIdentity identity = identity_of(needed);
  const auto before = options.store->last_entry(identity.hash());
  // What was thrown on the way is in the journal already.
  if (before && before->state != store::CaseState::timed_out && before->reason == outcome.failure) return;
  if (before && before->state == store::CaseState::done) return;
  store::JournalEntry entry = entry_for(needed, identity);
  entry.state = store::CaseState::failed;
  entry.reason = outcome.failure;
  options.store->note(std::move(entry));
}

Resources resources_of(const StudyOptions& options) { return {options.jobs, options.memory_limit}; }

std::string failure_of(const run::MechanicsResult& mechanics, const TaskOutcome& outcome) {
  if (!outcome.started) return "not run: the study was interrupted before";
  if (!outcome.failure.empty()) return "the run failed: " + outcome.failure;
  if (mechanics.status == run::RunStatus::completed) return {};
  return run::to_string(mechanics.status) + (mechanics.reason.empty() ? "" : ": " + mechanics.reason);
}

void add_run(Timing& timing, const run::MechanicsResult& mechanics, bool reused, const TaskOutcome& outcome) {
  if (!outcome.started || !outcome.failure.empty()) return;
  if (reused) {
    if (mechanics.status != run::RunStatus::timed_out) ++timing.reused;
    return;
  }
  ++timing.runs;
  timing.particle_updates += static_cast<double>(mechanics.steps) * static_cast<double>(mechanics.particles);
  timing.run_time += mechanics.wall_time;
}

std::vector<bool> cases_of_shard(const StudyFile& study, const Shard& shard) {
  std::vector<double> costs;
  for (const StudyCase& input : study.cases) costs.push_back(cost_of(input.scene.scene));
  std::vector<bool> ours;
  for (const int each : shards_of(costs, shard.count)) ours.push_back(each == shard.index);
  return ours;
}

int jobs_of(const StudyOptions& options) { return options.jobs > 0 ? options.jobs : available_cores(); }

bool stop_requested(const StudyOptions& options) { return options.stop != nullptr && options.stop->load(); }

}  // namespace detail
}  // namespace launchsafe::study
