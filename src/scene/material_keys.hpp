// The keys of the material tables of a scene file, one function a table. Used by scene_keys.cpp alone.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <vector>

namespace launchsafe::scene {

std::vector<Key<Scene>> steel_keys();
std::vector<Key<Scene>> charge_keys();
std::vector<Key<Scene>> kinetics_keys();

}  // namespace launchsafe::scene
