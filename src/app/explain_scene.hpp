// What a scene will compute and what that will cost.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

std::string scene_text(const scene::Scene& scene, double update_rate);
nlohmann::ordered_json scene_json(const scene::Scene& scene, double update_rate);

/// Every key of a scene file.
std::string keys_text();
nlohmann::ordered_json keys_json();

}  // namespace launchsafe::app
