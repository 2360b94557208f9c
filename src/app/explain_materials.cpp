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

using Json = nlohmann::ordered_json;
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
  return is_calibrated(material) ? "the constants of the 155 mm shell were calibrated with it"
                                 : "never calibrated: no verdict that rests on it is SAFE until somebody "
                                   "accepts it as it is, or calibrates it";
}

/// The value of a key, which has a name of its own in a material.
struct Number {
  std::string key, name, value;
};

/// In the order of their sources; the user's word is the source of those that have no other.
Json numbers_json(const std::vector<scene::Source>& sources, const std::vector<Number>& numbers) {
  Json list = Json::array();
  const auto add = [&list](const Number& number, scene::Standing standing, const std::string& citation) {
    list.push_back({{"key", number.name},
                    {"value", number.value},
                    {"standing", scene::letter_of(standing)},
                    {"citation", citation}});
  };
  for (const scene::Source& source : sources)
    for (const std::string& key : source.keys)
      add(*std::ranges::find(numbers, key, &Number::key), source.standing, source.citation);
  for (const Number& each : numbers)
    if (scene::source_of(sources, each.key) == nullptr)
      add(each, scene::Standing::input, "no source is given");
  return list;
}

Json json_of(const NamedMaterial& material) {
  std::vector<Number> numbers;
  for (const auto& [key, given] : material.values)
    numbers.push_back({key, scene::key_in_material(material.law, key),
                       scene::format_value(*scene::find_key(scene::scene_keys(), key), given.value)});
  return {{"name", material.name},
          {"title", material.title},
          {"what", fmt::format("law {}; {}{}", material.law, calibration_text(material),
                               self_heating_text(material))},
          {"law", material.law},
          {"calibrated", is_calibrated(material)},
          {"numbers", numbers_json(material.sources, numbers)}};
}

Json json_of(const scene::NamedContact& contact) {
  std::vector<Number> numbers;
  for (const auto& key : scene::interface_keys())
    if (!key.is_written || key.is_written(contact.faces))
      numbers.push_back({key.name, key.name, scene::format_value(key, key.get(contact.faces))});
  return {{"name", contact.name},
          {"title", contact.title},
          {"what", "contact of an interface"},
          {"numbers", numbers_json(contact.sources, numbers)}};
}

Json json_of(const scene::Decomposition& decomposition) {
  const double specific_heat = materials::Charge{}.specific_heat;
  const auto runaway = [&](double from) {
    return 1e3 * materials::adiabatic_runaway_time(decomposition.kinetics, specific_heat, from);
  };
  std::vector<Number> numbers;
  for (const auto& key : scene::decomposition_keys())
    if (key.name != "title")
      numbers.push_back({key.name, key.name, scene::format_value(key, key.get(decomposition))});
  return {{"name", decomposition.name},
          {"title", decomposition.title},
          {"what", "decomposition of a flame, combustion.kinetics; with the specific heat of comp-b it " +
                       report::runaway_text(decomposition.kinetics, specific_heat)},
          {"runaway_from_519_K_ms", runaway(519.0)},
          {"runaway_from_550_K_ms", runaway(550.0)},
          {"numbers", numbers_json(decomposition.sources, numbers)}};
}

/// The same for people.
std::string text_of(const Json& told) {
  const auto text_in = [](const Json& object, const char* key) { return object[key].get<std::string>(); };
  std::string text =
      fmt::format("{}: {}\n  {}\n", text_in(told, "name"), text_in(told, "title"), text_in(told, "what"));
  std::string source;
  for (const Json& number : told["numbers"]) {
    const std::string own =
        fmt::format("  [{}] {}\n", text_in(number, "standing"), text_in(number, "citation"));
    if (std::exchange(source, own) != own) text += own;
    text += fmt::format("      {:<32}{}\n", text_in(number, "key"), text_in(number, "value"));
  }
  return text;
}

/// Prints those whose name begins with a word; false where none does.
bool print_materials(const scene::NamedMaterials& named, const std::string& word, Console& console) {
  std::string text;
  const auto list_of = [&](const auto& all) {
    Json list = Json::array();
    for (const auto& each : all) {
      if (!each.name.starts_with(word)) continue;
      list.push_back(json_of(each));
      text += (text.empty() ? "" : "\n") + text_of(list.back());
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
