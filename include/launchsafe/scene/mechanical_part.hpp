// What of a scene the mechanics depends on.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

/// The scene with everything that cannot influence the mechanical run, its trace or its snapshots at its
/// default: title, file names and acceptances; gap, air (but for its initial pressure, below which no bottom
/// pressure is traced), exchange and localisation; numbers of the analytic load under a measured curve. The
/// plan's switches stand as decided, without what the decision rests on. Kinetics, heat conduction, friction
/// closure and specific heat of laws that do not heat themselves stay only where the plan, or a snapshot,
/// needs them, materials only where a body is made of them. Zeros have no sign. Names of bodies stay: a
/// failed run tells where it failed.
///
/// Scenes with equal mechanical parts share one mechanical run, bit by bit. The part of a valid scene is
/// valid.
Scene mechanical_part(const Scene& scene);

}  // namespace launchsafe::scene
