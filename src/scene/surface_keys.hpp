// The keys of the charge's bottom: gap and air, friction and stations.
#pragma once

#include "launchsafe/scene/scene_keys.hpp"

#include <vector>

namespace launchsafe::scene {

/// In the order in which they identify a run.
std::vector<Key<Scene>> surface_keys();

}  // namespace launchsafe::scene
