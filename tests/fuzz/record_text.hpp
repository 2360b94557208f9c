// Accuracy records that a fuzzer changed, with the digests that it cannot guess.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/file.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace launchsafe::fuzz {

/// The text with its "digest" that of the rest; as it is where it is no JSON object. Numbers stay as they are
/// written, so that only those as the program writes them have the right digest.
inline std::string with_digest(const std::string& text) {
  auto record = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!record.is_object()) return text;
  record.erase("digest");
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  record["digest"] = store::sha256(record.dump(-1, ' ', false, replace));
  return record.dump(2, ' ', false, replace);
}

/// The text with a scene, as the program writes it, in the place of "@scene", and with its digest; as it is
/// where it has no such place, or the scene cannot be read.
inline std::string with_scene(std::string text, const std::string& scene) {
  constexpr std::string_view mark = "\"@scene\"";
  const std::size_t at = text.find(mark);
  const auto file = scene::parse_scene(scene, "scene.toml");
  if (at == std::string::npos || !file) return text;
  return with_digest(
      text.replace(at, mark.size(), nlohmann::ordered_json(scene::to_toml(file->scene)).dump()));
}

}  // namespace launchsafe::fuzz
