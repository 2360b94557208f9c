// What may be wrong with the gap of a scene.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>

namespace launchsafe::scene {

/// Gaps twice, or without a charge; and what does not go with the model of the gap.
std::optional<InputError> fault_of_gap(const SceneFile& file);

}  // namespace launchsafe::scene
