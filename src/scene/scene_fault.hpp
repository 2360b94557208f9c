// A fault of a scene, at the place where the user gave the key.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>
#include <string>
#include <utility>

namespace launchsafe::scene {

using Fault = std::optional<InputError>;

inline InputError fault_at(const SceneFile& file, const std::string& key, std::string found,
                           std::string allowed, std::string suggestion = {}) {
  return error_at(place_of_key(file, key), key, std::move(found), std::move(allowed), std::move(suggestion));
}

}  // namespace launchsafe::scene
