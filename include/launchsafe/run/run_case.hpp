// One case: a scene in, a result out. The mechanics runs once and leaves a bottom trace; every gap is
// integrated on it.
#pragma once

#include "launchsafe/run/case_result.hpp"

#include <atomic>

namespace launchsafe::run {

/// How the caller observes and stops a running case.
struct RunOptions {
  /// Set from another thread (or a signal handler) to stop: the run ends within a few steps as `interrupted`.
  const std::atomic<bool>* stop = nullptr;
  /// s of wall time after which the run ends as `timed_out`.
  double time_limit = math::infinity;
  /// Called a few times a second of wall time from the running thread with the share done, 0..1.
  std::function<void(double)> progress;
  /// Threads that work on the steps of this one run; the result does not depend on their number.
  int threads = 1;
  /// Keeps checkpoints of the launch with the result of its mechanics (total-Lagrangian; none otherwise).
  bool checkpoints = false;
  /// For `run_with_skin` with two-way coupling: the finished mechanics of the same launch, from whose
  /// checkpoints it goes on. The scenes may differ in what does not influence the mechanics.
  const MechanicsResult* launch = nullptr;
  /// s, for `run_mechanics`: until then the scene's launch is `launch`, from whose checkpoints it goes on.
  double same_until = 0;
};

/// Runs the mechanics of a scene over its load's duration and records the bottom trace, the monitors and the
/// snapshots. Never throws on numerical failure: the status says what happened, and what was recorded until
/// then is kept. The result depends on the scene alone, bitwise, not on threads, on what else runs, or on
/// the launch from which it goes on.
MechanicsResult run_mechanics(const scene::Scene& scene, const RunOptions& options = {});

/// Skin temperatures of one gap (m) on a finished trace, with the trace's sampling error. The scene's surface
/// and kinetics parameters apply; its own list of gaps does not.
GapResult evaluate_gap(const scene::Scene& scene, const trace::BottomTrace& trace, double gap);

/// `run_mechanics` and `evaluate_gap` for each of the scene's gaps; with two-way coupling `run_with_skin` for
/// those that ignite, of which the combustion is kept with the snapshots from ignition on. Where a snapshot
/// of ignition is asked for, it is with one-way coupling of the launch at the earliest ignition of its gaps:
/// the launch is computed once more from its last checkpoint before, bitwise the same.
CaseResult run_case(const scene::Scene& scene, const RunOptions& options = {});

/// Events of which the scene asks for a snapshot and no run of the case has one: they did not happen.
std::vector<scene::Event> events_without_snapshot(const scene::Scene& scene, const CaseResult& result);

/// A complete run of one gap (m): the mechanics with its skin. It confirms a traced gap independently: below
/// ignition both must agree to integration tolerance.
///
/// With one-way coupling the skin is integrated at every time step instead of on the bottom trace, and has no
/// effect on the mechanics.
///
/// With two-way coupling what burns after ignition turns to gas and acts on all bodies
/// (burning_bottom.hpp), and the run ends a stated time after ignition or at a stated pressure instead of at
/// the end of the load, which goes on as it is stated beyond its duration. It goes on from the last
/// checkpoint of the launch before the gap ignites, or is hottest: bitwise the mechanics from the start,
/// until something burns. Up to there the skin is integrated on the trace, then at every step. Where the
/// launch did not complete, neither does this.
CaseResult run_with_skin(const scene::Scene& scene, double gap, const RunOptions& options = {});

// --- validity warnings: why a run that completed may still be no basis for a verdict ---

/// Reasons, each a clause for people, for which a completed run must not be trusted; none for a sound one.
/// They rest on the scene and on what the run recorded, so that stored runs can be judged too.
std::vector<std::string> validity_warnings(const scene::Scene& scene, const MechanicsResult& mechanics);

/// The same of what followed ignition in a run with two-way coupling. Until ignition inertia may be scaled;
/// gas that expands sets masses in motion, which must be the true ones. A measured load that ends before the
/// run is held at its last pressure.
std::vector<std::string> combustion_validity_warnings(const scene::Scene& scene,
                                                      const CombustionHistory& combustion);

/// What of the launch lies outside the simulated time, a clause each for people; nothing for one that begins
/// at rest, reaches its stated peak, and is over at the end: at a hundredth of its peak pressure, or where
/// the scene states the muzzle exit, behind which the pressure decays (scene/load.hpp).
std::vector<std::string> uncovered_load(const scene::Load& load);

}  // namespace launchsafe::run
