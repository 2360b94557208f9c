// What the end of a load must satisfy.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>

namespace launchsafe::scene {

/// The first fault of `load.muzzle_exit`, `.muzzle_travel` and what depends on them, or of a load without
/// end.
std::optional<InputError> fault_of_end(const SceneFile& file);

}  // namespace launchsafe::scene
