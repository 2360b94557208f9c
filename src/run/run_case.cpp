#include "launchsafe/run/run_case.hpp"

#include "runner.hpp"

#include <fmt/format.h>

#include <iterator>

namespace launchsafe::run {
namespace {

GapResult gap_result(const surface::SkinModel& model, surface::SkinHistory skin,
                     const trace::BottomTrace& trace) {
  GapResult result;
  result.gap = skin.gap;
  result.at_stations = surface::maximum_at_stations(skin, trace);
  result.at_points = surface::maximum_at_observation_points(skin, trace);
  result.air = surface::audit_air(model, trace, skin);
  result.skin = std::move(skin);
  return result;
}

/// A run with a gap, to its end.
CaseResult finished(Runner& runner, const scene::Scene& scene) {
  CaseResult result;
  result.mechanics = runner.run();
  result.gaps.push_back(gap_result(surface::skin_model(scene), runner.take_skin(), result.mechanics.trace));
  result.gaps.back().combustion = runner.take_combustion(result.mechanics);
  result.gaps.back().with_mechanics = true;
  return result;
}

/// How many checkpoints of a launch lie before a gap ignites, or is hottest.
std::size_t checkpoints_before(const trace::BottomTrace& launch, const GapResult& traced, double duration) {
  const double critical = traced.skin.ignition ? traced.skin.ignition->time : traced.at_stations.time;
  std::size_t count = 0;
  for (const double time : launch.time)
    if (time <= critical - scene::share_before_ignition * duration &&
        time >= Runner::time_of_checkpoint(count, duration))
      ++count;
  return count;
}

/// A complete run of a gap (m) with two-way coupling, from a checkpoint of its launch where there is one.
CaseResult continue_with_skin(const scene::Scene& scene, double gap, const MechanicsResult& launch,
                              const RunOptions& options) {
  CaseResult result;
  const GapResult traced = evaluate_gap(scene, launch.trace, gap);
  if (launch.status != RunStatus::completed) {
    result.mechanics = launch;
    result.gaps.push_back(traced);
    return result;
  }
  const bool total = scene.numerics.formulation == scene::Formulation::total_lagrangian;
  const std::size_t needed =
      total ? checkpoints_before(launch.trace, traced, scene::end_time(scene.load)) : 0;
  Runner runner(scene, options, gap);
  if (needed > 0) {
    // What was stored has none: the launch is computed again as far as needed.
    std::shared_ptr<const Checkpoints> checkpoints = launch.checkpoints;
    if (!checkpoints) {
      Runner again(scene, options, std::nullopt);
      again.keep_checkpoints(needed);
      result.mechanics = again.run();
      checkpoints = again.take_checkpoints();
    }
    if (checkpoints->runs.size() < needed) {  // broken off
      result.gaps.push_back(traced);
      return result;
    }
    runner.continue_from(*checkpoints->runs[needed - 1]);
  }
  return finished(runner, scene);
}

/// What is missing of a case says nothing of its launch.
void note_broken_off(CaseResult& result, double gap, const MechanicsResult& broken, const char* when) {
  if (result.mechanics.status != RunStatus::completed) return;  // of the first
  result.mechanics.status = broken.status;
  result.mechanics.reason = fmt::format("{} {:.6g} cm: {}", when, 100.0 * gap, broken.reason);
}

/// Snapshots of a run that burnt; those before are the launch's.
std::vector<Snapshot> from_ignition_on(CaseResult burnt) {
  std::vector<Snapshot>& snapshots = burnt.mechanics.snapshots;
  const std::optional<surface::Ignition>& ignition = burnt.gaps.front().skin.ignition;
  std::erase_if(snapshots, [&](const Snapshot& shot) { return !ignition || shot.time < ignition->time; });
  return std::move(snapshots);
}

/// Gives the snapshots of a launch the skins of its gaps.
void add_skins(const scene::Scene& scene, CaseResult& result) {
  const double ignition_temperature = surface::skin_model(scene).kinetics.ignition_temperature;
  for (Snapshot& shot : result.mechanics.snapshots)
    for (const GapResult& gap : result.gaps)
      add_skin(shot, gap, result.mechanics.trace, ignition_temperature);
}

/// The last checkpoint before a time (s), if there is one.
const Runner* last_before(const std::shared_ptr<const Checkpoints>& checkpoints, double time) {
  if (!checkpoints) return nullptr;
  const auto after =
      std::ranges::find_if(checkpoints->runs, [&](const auto& each) { return each->time() >= time; });
  return after == checkpoints->runs.begin() ? nullptr : std::prev(after)->get();
}

/// Takes a snapshot of a launch at the earliest ignition of its gaps, by a second run from the last
/// checkpoint before it, or from the start: bitwise what the launch had.
void add_snapshot_of_ignition(const scene::Scene& scene, CaseResult& result, const RunOptions& options) {
  double time = math::infinity;
  for (const GapResult& gap : result.gaps)
    if (gap.skin.ignition) time = std::min(time, gap.skin.ignition->time);
  if (!(time <= result.mechanics.end_time)) return;
  RunOptions own = options;
  own.progress = nullptr;
  Runner again(scene, own, std::nullopt);
  if (const Runner* checkpoint = last_before(result.mechanics.checkpoints, time))
    again.continue_from(*checkpoint);
  again.end_with_snapshot(time);
  std::vector<Snapshot>& snapshots = result.mechanics.snapshots;
  for (Snapshot& shot : again.run().snapshots) {
    shot.events = {scene::Event::ignition};
    snapshots.push_back(std::move(shot));
  }
  merge_instants(snapshots);
}

}  // namespace

MechanicsResult run_mechanics(const scene::Scene& scene, const RunOptions& options) {
  Runner runner(scene, options, std::nullopt);
  if (options.launch != nullptr)
    if (const Runner* checkpoint = last_before(options.launch->checkpoints, options.same_until))
      runner.continue_from(*checkpoint);
  if (options.checkpoints && scene.numerics.formulation == scene::Formulation::total_lagrangian)
    runner.keep_checkpoints();
  MechanicsResult result = runner.run();
  result.checkpoints = runner.take_checkpoints();
  return result;
}

GapResult evaluate_gap(const scene::Scene& scene, const trace::BottomTrace& trace, double gap) {
  const surface::SkinModel model = surface::skin_model(scene);
  GapResult result = gap_result(model, surface::integrate_skin(model, trace, gap), trace);
  const trace::BottomTrace coarse = trace::thinned(trace);
  const auto coarse_maximum =
      surface::maximum_at_stations(surface::integrate_skin(model, coarse, gap), coarse);
  result.sampling_error = std::abs(result.at_stations.temperature - coarse_maximum.temperature);
  return result;
}

CaseResult run_case(const scene::Scene& scene, const RunOptions& options) {
  RunOptions own = options;
  const bool burns = scene.coupling == scene::Coupling::two_way;
  const bool looks_at_ignition = !burns && scene.output.asks_for(scene::Event::ignition);
  own.checkpoints = burns || (looks_at_ignition && !scene.surface.gaps.empty());
  CaseResult result;
  result.mechanics = run_mechanics(scene, own);
  own.launch = &result.mechanics;
  if (!scene::has_charge(scene)) return result;
  for (const double gap : scene.surface.gaps) {
    result.gaps.push_back(evaluate_gap(scene, result.mechanics.trace, gap));
    GapResult& traced = result.gaps.back();
    if (!burns || !traced.skin.ignition || result.mechanics.status != RunStatus::completed) continue;
    CaseResult burnt = run_with_skin(scene, gap, own);
    traced.combustion = std::move(burnt.gaps.front().combustion);
    if (traced.combustion) traced.combustion->snapshots = from_ignition_on(std::move(burnt));
    const RunStatus status = burnt.mechanics.status;
    if (status == RunStatus::interrupted || status == RunStatus::timed_out)
      note_broken_off(result, gap, burnt.mechanics, "after ignition at");
  }
  if (looks_at_ignition) add_snapshot_of_ignition(scene, result, options);
  add_skins(scene, result);
  return result;
}

std::vector<scene::Event> events_without_snapshot(const scene::Scene& scene, const CaseResult& result) {
  std::vector<scene::Event> missing = scene.output.snapshot_events;
  const auto take_out = [&](const std::vector<Snapshot>& snapshots) {
    for (const Snapshot& shot : snapshots)
      for (const scene::Event event : shot.events) std::erase(missing, event);
  };
  take_out(result.mechanics.snapshots);
  for (const GapResult& gap : result.gaps)
    if (gap.combustion) take_out(gap.combustion->snapshots);
  return missing;
}

CaseResult run_with_skin(const scene::Scene& scene, double gap, const RunOptions& options) {
  if (scene.coupling == scene::Coupling::two_way) {
    if (options.launch != nullptr) return continue_with_skin(scene, gap, *options.launch, options);
    RunOptions own = options;
    own.checkpoints = true;
    return continue_with_skin(scene, gap, run_mechanics(scene, own), options);
  }
  Runner runner(scene, options, gap);
  return finished(runner, scene);
}

}  // namespace launchsafe::run
