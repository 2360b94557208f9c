#include "launchsafe/scene/input_content.hpp"

#include <algorithm>

namespace launchsafe::scene {
namespace {

struct Wording {
  const char *found, *allowed;
};

Wording wording_of(InputContent content) {
  switch (content) {
    case InputContent::study:
      return {"a study, which launchsafe study computes", "a study: a file with the keys kind and scene"};
    case InputContent::materials:
      return {"materials, which a scene's material_file names and launchsafe explain tells",
              "a file of tables [material.NAME] and [contact.NAME]"};
    case InputContent::scene:
    case InputContent::unknown:
      break;
  }
  return {"a scene, which launchsafe run computes", "a scene: a file with tables [[body]]"};
}

}  // namespace

InputContent content_of(const toml::table& root) {
  const auto of_materials = [](const auto& each) {
    return each.first.str() == "material" || each.first.str() == "contact" ||
           each.first.str() == "decomposition";
  };
  if (!root.empty() && std::all_of(root.begin(), root.end(), of_materials)) return InputContent::materials;
  if (root.contains("body")) return InputContent::scene;
  return root.contains("kind") || root.contains("scene") ? InputContent::study : InputContent::unknown;
}

std::optional<InputError> check_content(const toml::table& root, const std::string& file,
                                        InputContent wanted) {
  const InputContent content = content_of(root);
  if (content == wanted || content == InputContent::unknown) return std::nullopt;
  return error_at({file}, {}, wording_of(content).found, wording_of(wanted).allowed);
}

}  // namespace launchsafe::scene
