// Every key of a scene file, from the same descriptions that read it.
#include "explain_scene.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace launchsafe::app {
namespace {

std::string default_of(const scene::DocumentedKey& key) {
  if (key.description.required) return "must be given";
  if (key.default_text.empty()) return "default: none";
  return fmt::format("default: {}  [{}]", key.default_text, scene::letter_of(key.description.standing));
}

std::string standings() {
  using enum scene::Standing;
  std::string text;
  for (const scene::Standing standing : {paper, literature, derived, assumed, calibrated}) {
    text += fmt::format("{}[{}] {}", text.empty() ? "" : ", ", scene::letter_of(standing),
                        scene::meaning_of(standing));
  }
  return text;
}

}  // namespace

std::string keys_text() {
  std::string text = fmt::format(
      "Keys of a scene file; a key a.b is written b under [a]. Standing of a default: {}.\n", standings());
  for (const scene::DocumentedKey& key : scene::describe_keys()) {
    text += fmt::format("\n{}\n    {}\n    {}\n    {}\n", key.description.name, key.description.sentence,
                        scene::allowed_text(key.description), default_of(key));
  }
  return text;
}

nlohmann::ordered_json keys_json() {
  nlohmann::ordered_json keys = nlohmann::ordered_json::array();
  for (const scene::DocumentedKey& key : scene::describe_keys()) {
    keys.push_back({{"key", key.description.name},
                    {"si_unit", scene::si_unit_of(key.description.dimension)},
                    {"allowed", scene::allowed_text(key.description)},
                    {"default", key.default_text},
                    {"required", key.description.required},
                    {"standing", scene::letter_of(key.description.standing)},
                    {"sentence", key.description.sentence}});
  }
  return {{"keys", keys}};
}

}  // namespace launchsafe::app
