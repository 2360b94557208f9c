#include "explain_materials.hpp"

#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/named_contact.hpp"
#include "launchsafe/scene/named_material.hpp"
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

std::string text_of(const NamedMaterial& material) {
  std::string text = fmt::format("{}: {}\n  law {}; {}\n", material.name, material.title, material.law,
                                 calibration_text(material));
  for (const scene::Source& source : material.sources) {
    text += fmt::format("  [{}] {}\n", scene::letter_of(source.standing), source.citation);
    for (const std::string& key : source.keys)
      text += fmt::format("      {:<32}{}\n", scene::key_in_material(material.law, key),
                          value_text(key, material.values.at(key).value));
  }
  return text;
}

nlohmann::ordered_json json_of(const NamedMaterial& material) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (const scene::Source& source : material.sources)
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
  for (const scene::Source& source : contact.sources) {
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
  for (const scene::Source& source : contact.sources)
    for (const std::string& name : source.keys) {
      const auto& key = *scene::find_key(scene::interface_keys(), name);
      numbers.push_back({{"key", name},
                         {"value", scene::format_value(key, key.get(contact.faces))},
                         {"standing", scene::letter_of(source.standing)},
                         {"citation", source.citation}});
    }
  return {{"name", contact.name}, {"title", contact.title}, {"numbers", numbers}};
}

}  // namespace

ExitCode explain_materials(const std::string& word, Console& console) {
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
  const auto materials = list_of(scene::shipped_materials()), contacts = list_of(scene::shipped_contacts());
  if (text.empty())
    return console.refuse(
        fmt::format("explain --materials: found \"{}\", with which no shipped material or contact begins; "
                    "allowed: the beginning of a name, such as comp-b",
                    word));
  console.print_text(text);
  console.print_json({{"materials", materials}, {"contacts", contacts}});
  return ExitCode::done;
}

}  // namespace launchsafe::app
