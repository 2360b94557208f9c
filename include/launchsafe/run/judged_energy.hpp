// Below which energy nothing is said about an energy balance.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::run {

/// Elastic energy (J) that the bodies would hold under a hundredth of the load's peak, or of an atmosphere
/// where that is more: drift is not judged on less, where it would be the first cells' share in the first
/// steps, or round-off where there is no load.
double least_judged_energy(const scene::Scene& scene);

/// Impulse (N s) of a hundredth of an atmosphere on the base over the launch: likewise for momentum.
double least_judged_impulse(const scene::Scene& scene);

}  // namespace launchsafe::run
