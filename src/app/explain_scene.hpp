// What a scene will compute and what that will cost.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

std::string scene_text(const scene::Scene& scene, double update_rate);
nlohmann::ordered_json scene_json(const scene::Scene& scene, double update_rate);

/// The intervals of the grid between edges of bodies, and cells and particles of every body.
std::string grid_text(const scene::Scene& scene);
/// The same in SI, and every line of the grid.
nlohmann::ordered_json grid_json(const scene::Scene& scene);

/// Peaks, smoothing and roughness of a load, in SI.
nlohmann::ordered_json load_json(const scene::Load& load);

/// Every key of a scene file.
std::string keys_text();
nlohmann::ordered_json keys_json();

}  // namespace launchsafe::app
