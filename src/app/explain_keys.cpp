// Every key of a scene file and of a study file, from the same descriptions that read them.
#include "explain_scene.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

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

/// Empty where nothing is said.
std::string plausible_line(const scene::KeyDescription& key) {
  if (key.plausible.because.empty()) return {};
  return fmt::format("    plausible: {}\n", scene::plausible_text(key));
}

std::string derived_text() {
  std::string text =
      "Quantities that follow from the keys of a scene; what is not plausible of one gives "
      "validity warnings too.\n";
  for (const scene::DerivedQuantity& each : scene::derived_quantities()) {
    text += fmt::format("\n{}\n    {}\n{}", each.description.name, each.description.sentence,
                        plausible_line(each.description));
  }
  return text;
}

nlohmann::ordered_json derived_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::DerivedQuantity& each : scene::derived_quantities()) {
    list.push_back({{"quantity", each.description.name},
                    {"si_unit", scene::si_unit_of(each.description.dimension)},
                    {"plausible", scene::plausible_text(each.description)},
                    {"sentence", each.description.sentence}});
  }
  return list;
}

std::string documented(const std::vector<scene::DocumentedKey>& keys) {
  std::string text;
  for (const scene::DocumentedKey& key : keys) {
    text +=
        fmt::format("\n{}\n    {}\n    {}\n{}    {}\n", key.description.name, key.description.sentence,
                    scene::allowed_text(key.description), plausible_line(key.description), default_of(key));
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<scene::DocumentedKey>& keys) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::DocumentedKey& key : keys) {
    list.push_back({{"key", key.description.name},
                    {"si_unit", scene::si_unit_of(key.description.dimension)},
                    {"allowed", scene::allowed_text(key.description)},
                    {"plausible", scene::plausible_text(key.description)},
                    {"default", key.default_text},
                    {"required", key.description.required},
                    {"standing", scene::letter_of(key.description.standing)},
                    {"sentence", key.description.sentence}});
  }
  return list;
}

}  // namespace

std::string keys_text() {
  return fmt::format(
             "Keys of a scene file; a key a.b is written b under [a]. Standing of a default: {}.\n{}\n\n",
             standings(), documented(scene::describe_keys())) +
         derived_text() +
         "\n\nStudy files\n\nA study file also has [set], a table of scene keys with other values.\n" +
         documented(kinds::describe_study_keys());
}

nlohmann::ordered_json keys_json() {
  return {{"keys", json_of(scene::describe_keys())},
          {"derived_quantities", derived_json()},
          {"study_keys", json_of(kinds::describe_study_keys())}};
}

}  // namespace launchsafe::app
