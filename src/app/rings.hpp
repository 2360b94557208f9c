// The rings of a measured load beside the frequencies at which a shell swings along its axis.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

/// The first modes, and which ring is near one; empty without rings.
std::string rings_text(const scene::Load& load, const scene::Scene& shell);
/// The same in SI, with all modes; null without rings.
nlohmann::ordered_json rings_json(const scene::Load& load, const scene::Scene& shell);

}  // namespace launchsafe::app
