#include "explain_materials.hpp"

#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/material_file.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/calibration_domain.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace launchsafe::app {

namespace {

using scene::NamedMaterial;

/// Whether the shipped calibration was made with a material of these numbers.
bool is_calibrated(const NamedMaterial& material) {
  const study::Calibration calibration = study::shipped_calibration();
  scene::Scene with = calibration.scene;
  for (const auto& key : scene::scene_keys())
    if (const auto given = material.values.find(key.name); given != material.values.end())
      key.set(with, given->second.value);
  return study::distance_to_calibration(with, calibration).inside();
}

const char* calibration_text(const NamedMaterial& material) {
  return is_calibrated(material)
             ? "the constants of the 155 mm shell were calibrated with it"
             : "never calibrated: verdicts that rest on it are INDETERMINATE until somebody "
               "accepts the calibration, or calibrates it";
}

std::string value_text(const std::string& key, const scene::Value& value) {
  return scene::format_value(*scene::find_key(scene::scene_keys(), key), value);
}

/// The sources of all `keys`: those without one are the user's word.
std::vector<scene::Source> sources_of(std::vector<scene::Source> sources,
                                      const std::vector<std::string>& keys) {
  scene::Source unsaid{{}, scene::Standing::input, "no source is given"};
  for (const std::string& key : keys)
    if (scene::source_of(sources, key) == nullptr) unsaid.keys.push_back(key);
  if (!unsaid.keys.empty()) sources.push_back(std::move(unsaid));
  return sources;
}

std::vector<scene::Source> sources_of(const NamedMaterial& material) {
  std::vector<std::string> keys;
  for (const auto& [key, given] : material.values) keys.push_back(key);
  return sources_of(material.sources, keys);
}

std::vector<scene::Source> sources_of(const scene::NamedContact& contact) {
  std::vector<std::string> keys;
  for (const auto& key : scene::interface_keys())
    if (!key.is_written || key.is_written(contact.faces)) keys.push_back(key.name);
  return sources_of(contact.sources, keys);
}

std::string text_of(const NamedMaterial& material) {
  std::string text = fmt::format("{}: {}\n  law {}; {}\n", material.name, material.title, material.law,
                                 calibration_text(material));
  for (const scene::Source& source : sources_of(material)) {
    text += fmt::format("  [{}] {}\n", scene::letter_of(source.standing), source.citation);
    for (const std::string& key : source.keys)
      text += fmt::format("      {:<32}{}\n", scene::key_in_material(material.law, key),
                          value_text(key, material.values.at(key).value));
  }
  return text;
}

nlohmann::ordered_json json_of(const NamedMaterial& material) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (const scene::Source& source : sources_of(material))
    for (const std::string& key : source.keys)
      numbers.push_back({{"key", scene::key_in_material(material.law, key)},
                         {"value", value_text(key, material.values.at(key).value)},
                         {"standing", scene::letter_of(source.standing)},
                         {"citation", source.citation}});
  return {{"name", material.name},
          {"title", material.title},
          {"law", material.law},
          {"calibrated", is_calibrated(material)},
          {"numbers", numbers}};
}

std::string text_of(const scene::NamedContact& contact) {
  std::string text = fmt::format("{}: {}\n  contact of an interface\n", contact.name, contact.title);
  for (const scene::Source& source : sources_of(contact)) {
    text += fmt::format("  [{}] {}\n", scene::letter_of(source.standing), source.citation);
    for (const std::string& name : source.keys) {
      const auto& key = *scene::find_key(scene::interface_keys(), name);
      text += fmt::format("      {:<32}{}\n", name, scene::format_value(key, key.get(contact.faces)));
    }
  }
  return text;
}

nlohmann::ordered_json json_of(const scene::NamedContact& contact) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (const scene::Source& source : sources_of(contact))
    for (const std::string& name : source.keys) {
      const auto& key = *scene::find_key(scene::interface_keys(), name);
      numbers.push_back({{"key", name},
                         {"value", scene::format_value(key, key.get(contact.faces))},
                         {"standing", scene::letter_of(source.standing)},
                         {"citation", source.citation}});
    }
  return {{"name", contact.name}, {"title", contact.title}, {"numbers", numbers}};
}

/// Prints those whose name begins with a word; false where none does.
bool print_materials(const scene::NamedMaterials& named, const std::string& word, Console& console) {
  std::string text;
  const auto list_of = [&](const auto& all) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& each : all) {
      if (!each.name.starts_with(word)) continue;
      text += (text.empty() ? "" : "\n") + text_of(each);
      list.push_back(json_of(each));
    }
    return list;
  };
  const auto materials = list_of(named.materials), contacts = list_of(named.contacts);
  if (text.empty()) return false;
  console.print_text(text);
  console.print_json({{"materials", materials}, {"contacts", contacts}});
  return true;
}

}  // namespace

ExitCode explain_materials(const std::string& word, Console& console) {
  if (print_materials(scene::shipped_named_materials(), word, console)) return ExitCode::done;
  return console.refuse(
      fmt::format("explain --materials: found \"{}\", with which no shipped material or contact begins; "
                  "allowed: the beginning of a name, such as comp-b",
                  word));
}

ExitCode explain_material_file(const std::filesystem::path& file, Console& console) {
  const auto named = scene::read_material_file(file);
  if (!named) return console.refuse(named.error());
  if (print_materials(*named, {}, console)) return ExitCode::done;
  return console.refuse(
      fmt::format("{}: found no material and no contact; allowed: tables [material.NAME] and [contact.NAME]",
                  file.string()));
}

}  // namespace launchsafe::app
