// The keys of [load], under their names in that table.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <vector>

namespace launchsafe::scene {

std::vector<Key<Load>> load_keys();

}  // namespace launchsafe::scene
