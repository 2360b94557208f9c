// launchsafe explain of materials: every number and where it comes from.
#include "explain_program.hpp"
#include "launchsafe/report/kinetics_text.hpp"
#include "launchsafe/scene/decomposition.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/named_material.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/calibration_domain.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::app {

namespace {

using scene::NamedMaterial;

/// A scene with the numbers of a material.
scene::Scene with_material(scene::Scene scene, const NamedMaterial& material) {
  for (const auto& key : scene::scene_keys())
    if (const auto given = material.values.find(key.name); given != material.values.end())
      key.set(scene, given->second.value);
  return scene;
}

/// Whether the shipped calibration was made with a material of these numbers.
bool is_calibrated(const NamedMaterial& material) {
  const study::Calibration calibration = study::shipped_calibration();
  return study::distance_to_calibration(with_material(calibration.scene, material), calibration).inside();
}

/// How fast an explosive heats itself by its own kinetics; empty for other laws.
std::string self_heating_text(const NamedMaterial& material) {
  if (material.law != "charge") return {};
  const materials::Charge charge = with_material({}, material).charge();
  return "; " + report::runaway_text(charge.kinetics, charge.specific_heat);
}

const char* calibration_text(const NamedMaterial& material) {
  return is_calibrated(material)
             ? "the constants of the 155 mm shell were calibrated with it"
             : "never calibrated: no verdict that rests on it is SAFE until somebody accepts it "
               "as it is, or calibrates it";
}

/// The value of a key, which has a name of its own in a material.
struct Number {
  std::string key, name, value;
};

/// A material or a contact as it is told.
struct Told {
  std::string name, title, what;
  std::vector<scene::Source> sources;  ///< of all its keys
  std::vector<Number> numbers;

  const Number& number(const std::string& key) const {
    return *std::find_if(numbers.begin(), numbers.end(), [&](const Number& each) { return each.key == key; });
  }
};

/// What is told of a material or a contact, with the user's word as the source of keys that have no other.
template <class Named>
Told told(const Named& named, std::string what, std::vector<Number> numbers) {
  Told told{named.name, named.title, std::move(what), named.sources, std::move(numbers)};
  scene::Source unsaid{{}, scene::Standing::input, "no source is given"};
  for (const Number& each : told.numbers)
    if (scene::source_of(named.sources, each.key) == nullptr) unsaid.keys.push_back(each.key);
  if (!unsaid.keys.empty()) told.sources.push_back(std::move(unsaid));
  return told;
}

Told told(const NamedMaterial& material) {
  std::vector<Number> numbers;
  for (const auto& [key, given] : material.values)
    numbers.push_back({key, scene::key_in_material(material.law, key),
                       scene::format_value(*scene::find_key(scene::scene_keys(), key), given.value)});
  return told(
      material,
      fmt::format("law {}; {}{}", material.law, calibration_text(material), self_heating_text(material)),
      std::move(numbers));
}

Told told(const scene::NamedContact& contact) {
  std::vector<Number> numbers;
  for (const auto& key : scene::interface_keys())
    if (!key.is_written || key.is_written(contact.faces))
      numbers.push_back({key.name, key.name, scene::format_value(key, key.get(contact.faces))});
  return told(contact, "contact of an interface", std::move(numbers));
}

Told told(const scene::Decomposition& decomposition) {
  std::vector<Number> numbers;
  for (const auto& key : scene::decomposition_keys())
    if (key.name != "title")
      numbers.push_back({key.name, key.name, scene::format_value(key, key.get(decomposition))});
  return told(decomposition,
              "decomposition of a flame, combustion.kinetics; with the specific heat of comp-b it " +
                  report::runaway_text(decomposition.kinetics, materials::Charge{}.specific_heat),
              std::move(numbers));
}

std::string text_of(const Told& told) {
  std::string text = fmt::format("{}: {}\n  {}\n", told.name, told.title, told.what);
  for (const scene::Source& source : told.sources) {
    text += fmt::format("  [{}] {}\n", scene::letter_of(source.standing), source.citation);
    for (const std::string& key : source.keys)
      text += fmt::format("      {:<32}{}\n", told.number(key).name, told.number(key).value);
  }
  return text;
}

nlohmann::ordered_json numbers_json(const Told& told) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (const scene::Source& source : told.sources)
    for (const std::string& key : source.keys)
      numbers.push_back({{"key", told.number(key).name},
                         {"value", told.number(key).value},
                         {"standing", scene::letter_of(source.standing)},
                         {"citation", source.citation}});
  return numbers;
}

nlohmann::ordered_json json_of(const NamedMaterial& material) {
  return {{"name", material.name},
          {"title", material.title},
          {"law", material.law},
          {"calibrated", is_calibrated(material)},
          {"numbers", numbers_json(told(material))}};
}

nlohmann::ordered_json json_of(const scene::Decomposition& decomposition) {
  const auto runaway = [&](double from) {
    return 1e3 *
           materials::adiabatic_runaway_time(decomposition.kinetics, materials::Charge{}.specific_heat, from);
  };
  return {{"name", decomposition.name},
          {"title", decomposition.title},
          {"runaway_from_519_K_ms", runaway(519.0)},
          {"runaway_from_550_K_ms", runaway(550.0)},
          {"numbers", numbers_json(told(decomposition))}};
}

nlohmann::ordered_json json_of(const scene::NamedContact& contact) {
  return {{"name", contact.name}, {"title", contact.title}, {"numbers", numbers_json(told(contact))}};
}

/// Prints those whose name begins with a word; false where none does.
bool print_materials(const scene::NamedMaterials& named, const std::string& word, Console& console) {
  std::string text;
  const auto list_of = [&](const auto& all) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& each : all) {
      if (!each.name.starts_with(word)) continue;
      text += (text.empty() ? "" : "\n") + text_of(told(each));
      list.push_back(json_of(each));
    }
    return list;
  };
  const auto materials = list_of(named.materials), contacts = list_of(named.contacts),
             decompositions = list_of(named.decompositions);
  if (text.empty()) return false;
  console.print_text(text);
  console.print_json({{"materials", materials}, {"contacts", contacts}, {"decompositions", decompositions}});
  return true;
}

}  // namespace

ExitCode explain_materials(const std::string& word, Console& console) {
  if (print_materials(
          {scene::shipped_materials(), scene::shipped_contacts(), scene::shipped_decompositions()}, word,
          console))
    return ExitCode::done;
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
