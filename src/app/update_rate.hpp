// How fast this machine is.
#pragma once

#include "console.hpp"
#include "launchsafe/scene/scene.hpp"

#include <optional>

namespace launchsafe::app {

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run, on a coarser mesh where its own has very many particles; nothing when the user
/// stops it, which is said.
std::optional<double> measured_update_rate(const scene::Scene& scene, Console& console);

}  // namespace launchsafe::app
