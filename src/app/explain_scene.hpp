// What a scene will compute and what that will cost.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run; 0 when the user stops it.
double measured_update_rate(const scene::Scene& scene);

std::string scene_text(const scene::Scene& scene, double update_rate);
nlohmann::ordered_json scene_json(const scene::Scene& scene, double update_rate);

/// Every key of a scene file.
std::string keys_text();
nlohmann::ordered_json keys_json();

}  // namespace launchsafe::app
