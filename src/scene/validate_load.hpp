// What a load must satisfy beyond the range of each key.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>

namespace launchsafe::scene {

/// The first fault of a measured curve, of what stands beside it, or of the end of the load.
std::optional<InputError> fault_of_load(const SceneFile& file);

}  // namespace launchsafe::scene
