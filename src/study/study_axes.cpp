// The scene keys that a study varies, and what is wrong with a study and where.
#include "launchsafe/study/study_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace launchsafe::study {
namespace {

using scene::InputError, scene::KeyDescription, scene::KeyKind, scene::Place;

using Tables = std::vector<const toml::table*>;

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The fault of a name that no scene key and no short name has, or of a scene key that takes no number.
InputError unfit_key(const StudyFile& study, const std::string& name, const std::string& faulty_key,
                     const Place& place, const std::vector<std::string>& short_names) {
  if (const auto any = scene::describe_key(study.scene, name, place)) {
    constexpr std::array takes{"a number", "true or false", "a word", "words", "a text", "a list", "a range"};
    return scene::error_at(
        place, faulty_key,
        fmt::format("{}, which takes {}", name, takes.at(static_cast<std::size_t>(any->kind))),
        "a scene key that takes one number, or " + joined(short_names));
  }
  std::vector<std::string> known = short_names;
  for (const auto& key : scene::scene_keys()) {
    if (key.kind == KeyKind::number) known.push_back(key.name);
  }
  const InputError unknown = scene::unknown_key(place, name, known);
  const std::string allowed =
      unknown.allowed.starts_with("in [")
          ? unknown.allowed
          : joined(short_names) + ", or a scene key that takes one number, such as load.steepness";
  return scene::error_at(place, faulty_key, fmt::format("the unknown key \"{}\"", name), allowed,
                         unknown.suggestion);
}

/// The peak matters under a measured curve that is rescaled to it; the other numbers of the analytic shape
/// never do.
Fault check_load_axis(const StudyFile& study, const std::string& key, const std::string& scene_key) {
  const auto* known = scene::find_key(scene::scene_keys(), scene_key);
  if (known == nullptr || !known->is_replaced || !known->is_replaced(study.scene.scene)) return std::nullopt;
  if (scene_key == "load.peak")
    return fault_at(study, key, "peak pressures for a measured curve that is not rescaled",
                    "peak pressures with load.rescale_to_peak = true in the scene");
  return fault_at(study, key, scene_key + ", which a measured curve does not have",
                  "a scene without a measured curve, or a key that has an effect");
}

}  // namespace

scene::Expected<Tables> tables_of(const toml::table& root, const std::string& name, const std::string& file) {
  return scene::tables_of(root, name, file, fmt::format("tables, each written [[{}]]", name));
}

scene::Expected<Tables> some_tables_of(const toml::table& root, const std::string& name,
                                       const StudyFile& study, const std::string& content) {
  const std::string allowed = fmt::format("at least one table, written [[{}]], {}", name, content);
  auto tables = scene::tables_of(root, name, study.file, allowed);
  if (!tables || !tables->empty()) return tables;
  return scene::error_at(place_of_key(study, root.contains(name) ? name : "kind"), name, "no " + name,
                         allowed);
}

scene::Expected<std::string> read_named_file(const StudyFile& study, const std::filesystem::path& folder,
                                             const std::string& key, const std::string& name,
                                             const std::string& wanted) {
  auto text = scene::read_text_file(folder / name);
  if (text) return text;
  return fault_at(study, key, fmt::format("\"{}\", which cannot be read", name),
                  wanted + ", by its path from the study file's folder", text.error().suggestion);
}

std::vector<Leaf> leaves_as_written(const toml::table& table) {
  std::vector<Leaf> leaves = scene::leaves_as_written(table, {});
  std::erase_if(leaves, [](const Leaf& leaf) { return leaf.node->is_table(); });
  return leaves;
}

std::string name_of_axis(const std::string& scene_key) {
  const auto named = std::ranges::find(named_axes(), scene_key, &NamedAxis::key);
  return named == named_axes().end() ? scene_key : named->name;
}

const std::vector<NamedAxis>& named_axes() {
  static const std::vector<NamedAxis> axes{{"peak_pressure", "load.peak"},
                                           {"crack_radius", "charge.crack_radius"},
                                           {"flaw_size", "charge.flaw_size"}};
  return axes;
}

scene::Expected<KeyDescription> varied_key(const StudyFile& study, const std::string& name,
                                           const std::string& faulty_key, const Place& place) {
  const auto named = std::ranges::find(named_axes(), name, &NamedAxis::name);
  const std::string& wanted = named == named_axes().end() ? name : named->key;
  auto key = scene::describe_key(study.scene, wanted, place);
  if (!key || key->kind != KeyKind::number) {
    std::vector<std::string> short_names;
    for (const NamedAxis& axis : named_axes()) short_names.push_back(axis.name);
    return unfit_key(study, name, faulty_key, place, short_names);
  }
  return key;
}

double number_in(const scene::SceneFile& file, const std::string& key) {
  return std::get<double>(scene::value_in(file, key));
}

Fault check_load_axes(const StudyFile& study) {
  for (const Axis& axis : study.study.axes) {
    if (Fault fault = check_load_axis(study, axis.study_key, axis.key.name)) return fault;
  }
  return std::nullopt;
}

Fault add_axis(StudyFile& study, const std::string& name, const std::string& study_key,
               std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  auto key = varied_key(study, name, study_key, place_of_key(study, study_key));
  if (!key) return key.error();
  if (Fault fault = check_twice(study, study_key, key->dimension, values)) return fault;
  study.study.axes.push_back({name_of_axis(key->name), study_key, std::move(*key), std::move(values)});
  return std::nullopt;
}

Fault check_free(const StudyFile& study, const std::string& scene_key, const Place& place,
                 const std::string& faulty_key) {
  if (study.overrides.contains(scene_key)) {
    return scene::error_at(place, faulty_key, scene_key + ", which [set] or the calibration fixes",
                           fmt::format("{} either in [[vary]], or in [set] or a calibration", scene_key));
  }
  for (const Axis& other : study.study.axes) {
    if (other.key.name != scene_key) continue;
    return scene::error_at(place, faulty_key,
                           fmt::format("{} a second time, after {}", scene_key, other.name),
                           "each scene key once");
  }
  return std::nullopt;
}

Fault check_twice(const StudyFile& study, const std::string& key, scene::Dimension dimension,
                  std::vector<double> values) {
  std::ranges::sort(values);
  const auto twice = std::adjacent_find(values.begin(), values.end(), [](double a, double b) {
    return b - a <= 1e-9 * std::max(std::abs(b), 1e-6);
  });
  if (twice == values.end()) return std::nullopt;
  return fault_at(study, key, scene::format_quantity(*twice, dimension) + " twice", "each value once");
}

}  // namespace launchsafe::study
