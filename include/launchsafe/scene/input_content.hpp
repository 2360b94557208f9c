// What a file of input is of: people give a study where a scene is asked for, and the other way round.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"

#include <optional>
#include <string>

namespace launchsafe::scene {

enum class InputContent { scene, study, materials, unknown };

/// By its keys: a scene has bodies; a study names its kind or its scene; a file of materials has nothing but
/// materials and contacts.
InputContent content_of(const toml::table& root);

/// The fault of a file that is clearly of something else than is wanted.
std::optional<InputError> check_content(const toml::table& root, const std::string& file,
                                        InputContent wanted);

}  // namespace launchsafe::scene
