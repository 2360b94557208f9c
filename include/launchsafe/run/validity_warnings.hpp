// Validity warnings: why a run that completed may still be no basis for a verdict.
#pragma once

#include "launchsafe/run/case_result.hpp"

namespace launchsafe::run {

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
/// the scene states the muzzle exit, behind which the pressure decays (scene/launch_end.hpp).
std::vector<std::string> uncovered_load(const scene::Load& load);

}  // namespace launchsafe::run
