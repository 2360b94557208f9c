// How fast this machine is.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::app {

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run, on a coarser mesh where its own has very many particles; 0 when the user stops it.
double measured_update_rate(const scene::Scene& scene);

}  // namespace launchsafe::app
