// The checks by topic, one file each.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/verify/check.hpp"

#include <vector>

namespace launchsafe::verify {

using Checks = std::vector<Check>;

/// Air, JWL, virial gas, steel, cracks, relaxation, and the statistics of studies.
std::vector<Computation> material_computations();
/// The heated skin at the charge bottom and the film of air under it: induction times, exact solutions,
/// conservation.
std::vector<Computation> surface_computations();
/// Elastic waves, states of rest, momentum and energy, in either formulation.
std::vector<Computation> wave_computations(scene::Formulation formulation);
std::vector<Computation> static_computations(scene::Formulation formulation);
std::vector<Computation> launch_computations(scene::Formulation formulation);
/// Heat conduction, a scheme of its own on the bodies' particles.
std::vector<Computation> conduction_computations();

}  // namespace launchsafe::verify
