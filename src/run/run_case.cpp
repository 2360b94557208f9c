#include "launchsafe/run/run_case.hpp"

#include "runner.hpp"

#include <fmt/format.h>

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

/// Takes a snapshot of a launch at the earliest ignition of its gaps, by a second run up to
/// there: bitwise what the launch had.
void add_snapshot_of_ignition(const scene::Scene& scene, CaseResult& result, const RunOptions& options) {
  double time = math::infinity;
  for (const GapResult& gap : result.gaps)
    if (gap.skin.ignition) time = std::min(time, gap.skin.ignition->time);
  if (!(time <= result.mechanics.end_time)) return;
  RunOptions own = options;
  own.progress = nullptr;
  Runner again(scene, own, std::nullopt);
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
  return Runner(scene, options, std::nullopt).run();
}

GapResult evaluate_gap(const scene::Scene& scene, const trace::BottomTrace& trace, double gap) {
  const surface::SkinModel model = surface::skin_model(scene);
  return gap_result(model, surface::integrate_skin(model, trace, gap), trace);
}

CaseResult run_case(const scene::Scene& scene, const RunOptions& options) {
  const bool burns = scene.coupling == scene::Coupling::two_way;
  CaseResult result;
  result.mechanics = run_mechanics(scene, options);
  if (!scene::has_charge(scene)) return result;
  for (const double gap : scene.surface.gaps) {
    result.gaps.push_back(evaluate_gap(scene, result.mechanics.trace, gap));
    GapResult& traced = result.gaps.back();
    if (!burns || !traced.skin.ignition || result.mechanics.status != RunStatus::completed) continue;
    CaseResult burnt = run_with_skin(scene, gap, options);
    traced.combustion = std::move(burnt.gaps.front().combustion);
    if (traced.combustion) traced.combustion->snapshots = from_ignition_on(std::move(burnt));
    const RunStatus status = burnt.mechanics.status;
    if (status == RunStatus::interrupted || status == RunStatus::timed_out)
      note_broken_off(result, gap, burnt.mechanics, "after ignition at");
  }
  if (!burns && scene.output.asks_for(scene::Event::ignition))
    add_snapshot_of_ignition(scene, result, options);
  add_skins(scene, result);
  return result;
}

CaseResult run_with_skin(const scene::Scene& scene, double gap, const RunOptions& options) {
  Runner runner(scene, options, gap);
  CaseResult result;
  result.mechanics = runner.run();
  result.gaps.push_back(gap_result(surface::skin_model(scene), runner.take_skin(), result.mechanics.trace));
  result.gaps.back().combustion = runner.take_combustion(result.mechanics);
  return result;
}

}  // namespace launchsafe::run
