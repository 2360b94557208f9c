// Accuracy records that a fuzzer changed, with the scene that it cannot guess.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace launchsafe::fuzz {

/// The text with a scene, as the program writes it, in the place of "@scene"; as it is where it has no such
/// place, or the scene cannot be read.
inline std::string with_scene(std::string text, const std::string& scene) {
  constexpr std::string_view mark = "\"@scene\"";
  const std::size_t at = text.find(mark);
  const auto file = scene::parse_scene(scene, "scene.toml");
  if (at == std::string::npos || !file) return text;
  return text.replace(at, mark.size(), nlohmann::ordered_json(scene::to_toml(file->scene)).dump());
}

}  // namespace launchsafe::fuzz
