// What a scene will compute and what that will cost.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

std::string scene_text(const scene::Scene& scene, double update_rate);
nlohmann::ordered_json scene_json(const scene::Scene& scene, double update_rate);

/// Peaks, smoothing and roughness of a load, in SI.
nlohmann::ordered_json load_json(const scene::Scene& scene);

/// Key, value, plausible range and acceptance (or null) of every value that is not plausible.
nlohmann::ordered_json plausibility_json(const scene::Scene& scene);

/// The first modes of a shell beside the rings of a measured load, and which ring is near one; empty without
/// rings.
std::string rings_text(const scene::Load& load, const scene::Scene& shell);
/// The same in SI, with all modes; null without rings.
nlohmann::ordered_json rings_json(const scene::Load& load, const scene::Scene& shell);

}  // namespace launchsafe::app
