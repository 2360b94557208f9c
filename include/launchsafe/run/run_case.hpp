// One case: a scene in, a result out. The mechanics runs once and leaves a bottom trace; every gap is
// integrated on it.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/run/warning.hpp"

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
};

/// Runs the mechanics of a scene over its load's duration and records the bottom trace, the monitors and the
/// snapshots. Never throws on numerical failure: the status says what happened, and what was recorded until
/// then is kept. The result depends on the scene alone, bitwise, not on what else runs.
MechanicsResult run_mechanics(const scene::Scene& scene, const RunOptions& options = {});

/// Skin temperatures of one gap (m) on a finished trace. The scene's surface and kinetics parameters apply;
/// its own list of gaps does not.
GapResult evaluate_gap(const scene::Scene& scene, const trace::BottomTrace& trace, double gap);

/// `run_mechanics` and `evaluate_gap` for each of the scene's gaps; with two-way coupling `run_with_skin` for
/// those that ignite, of which the combustion is kept with the snapshots from ignition on. Where a snapshot
/// of ignition is asked for, it is with one-way coupling of the launch at the earliest ignition of its gaps:
/// the launch is computed once more up to there, bitwise the same.
CaseResult run_case(const scene::Scene& scene, const RunOptions& options = {});

/// A complete run of one gap (m): the mechanics with its skin. It confirms a traced gap independently: below
/// ignition both must agree to integration tolerance.
///
/// The skin is integrated at every time step instead of on the bottom trace. With one-way coupling it has no
/// effect on the mechanics.
///
/// With two-way coupling what burns after ignition turns to gas and acts on all bodies
/// (burning_bottom.hpp), and the run ends a stated time after ignition or at a stated pressure instead of at
/// the end of the load, which goes on as it is stated beyond its duration. Until something burns it is
/// bitwise the launch.
CaseResult run_with_skin(const scene::Scene& scene, double gap, const RunOptions& options = {});

// --- validity warnings: why a run that completed may still be no basis for a verdict ---

/// Warnings of the computation and of the shell; none for a sound run. They follow from the scene and from
/// recorded results, so that stored runs can be judged too.
std::vector<Warning> validity_warnings(const scene::Scene& scene, const MechanicsResult& mechanics);

/// Warnings of the launch, from the motion of the projectile as one rigid body until the muzzle exit, or
/// until the end where there is none: "low-velocity", "high-velocity", "short-travel". No computation is
/// needed.
std::vector<Warning> launch_warnings(const scene::Scene& scene);

/// Reasons, a clause each, for which results after ignition must not be trusted in a run with two-way
/// coupling. Until ignition inertia may be scaled; gas that expands sets masses in motion, which must be the
/// true ones. A measured load that ends before the run is held at its last pressure.
std::vector<std::string> combustion_validity_warnings(const scene::Scene& scene,
                                                      const CombustionHistory& combustion);

/// Parts of the launch that the simulated time leaves out, a clause each. None for a launch that begins at
/// rest, reaches its stated peak, and is over at the end: at a hundredth of its peak pressure, or where the
/// scene states the muzzle exit, behind which the pressure decays (scene/load.hpp).
std::vector<std::string> uncovered_load(const scene::Load& load);

}  // namespace launchsafe::run
