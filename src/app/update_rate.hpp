// How fast this machine is.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::app {

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run; 0 when the user stops it.
double measured_update_rate(const scene::Scene& scene);

}  // namespace launchsafe::app
