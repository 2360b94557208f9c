#include "launchsafe/kinds/read_study.hpp"

#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "launchsafe/study/study_calibration.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/study/study_uncertainty.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <utility>

namespace launchsafe::kinds {

using namespace study;

namespace {

using scene::Dimension, scene::InputError, scene::Place;

/// Whether a kind has a key or a table of that name for itself.
bool has(const Kind& kind, const std::string& name) {
  return scene::find_key(kind.keys, name) != nullptr ||
         std::any_of(kind.tables.begin(), kind.tables.end(),
                     [&](const StudyTable& table) { return table.name == name; });
}

std::vector<std::string> kinds_with(const std::string& name) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) {
    if (has(kind, name)) names.push_back(kind.traits.name);
  }
  return names;
}

/// The tables of all study files that are read apart from the keys.
std::vector<std::string> common_tables() { return {"set", "accept"}; }

/// Every key and every table that some kind has.
void add_keys_of_all_kinds(StudyKeys& keys, std::vector<std::string>& tables) {
  for (const Kind& kind : kinds()) {
    keys = joined({std::move(keys), kind.keys});
    for (const StudyTable& table : kind.tables) tables.push_back(table.name);
  }
}

/// The kind that a study file names. Where it names none, a key that no kind has is the first fault.
scene::Expected<const Kind*> read_kind(const toml::table& root, const std::string& file) {
  const toml::node* node = root.get("kind");
  if (!node) {
    StudyKeys keys = common_keys();
    std::vector<std::string> tables = common_tables();
    add_keys_of_all_kinds(keys, tables);
    return scene::read_described(root, scene::descriptions_of(keys), tables, file).error();
  }
  const auto value = scene::read_value(*node, *scene::find_key(common_keys(), "kind"), file);
  if (!value) return value.error();
  return &kind_named(std::get<std::string>(*value));
}

/// A key of the file, or a table that is read apart from the keys.
struct Named {
  std::string name;
  const toml::node* node = nullptr;
};

std::vector<Named> names_in(const toml::table& root) {
  std::vector<Named> names;
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    const toml::table* table = node.as_table();
    if (table == nullptr || !kinds_with(name).empty()) {
      names.push_back({name, &node});
      continue;
    }
    for (const Leaf& leaf : leaves_as_written(*table)) names.push_back({name + "." + leaf.name, leaf.node});
  }
  return names;
}

/// The first key or table of another kind, which would silently do nothing.
Fault check_kind(const toml::table& root, const Kind& kind, const std::string& file) {
  const Named* first = nullptr;
  const std::vector<Named> names = names_in(root);
  for (const Named& each : names) {
    if (kinds_with(each.name).empty() || has(kind, each.name)) continue;
    if (!first || each.node->source().begin.line < first->node->source().begin.line) first = &each;
  }
  if (!first) return std::nullopt;
  const auto instead = std::find_if(kind.instead_of.begin(), kind.instead_of.end(),
                                    [&](const auto& each) { return each.first == first->name; });
  return scene::error_at(scene::place_of(*first->node, file), first->name,
                         "a key of kind " + scene::quoted_list(kinds_with(first->name)),
                         "keys of kind \"" + kind.traits.name + '"',
                         instead == kind.instead_of.end() ? std::string{} : instead->second);
}

/// The keys of the study file, with their places.
Fault read_keys(const toml::table& root, const Kind& kind, const StudyKeys& keys, StudyFile& study) {
  std::vector<std::string> tables = common_tables();
  for (const StudyTable& table : kind.tables) tables.push_back(table.name);
  auto read = scene::read_table(root, keys, tables, study.file, study.study);
  if (!read) return read.error();
  study.places = std::move(*read);
  for (const std::string& name : tables) {
    if (const toml::node* node = root.get(name)) study.places[name] = scene::place_of(*node, study.file);
  }
  return check_twice(study, "gaps", Dimension::length, study.study.gaps);
}

Fault read_scene_of(StudyFile& study, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / study.study.scene;
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    const auto missing = scene::read_text_file(path);
    return scene::error_at(place_of_key(study, "scene"), "scene",
                           fmt::format("\"{}\", which does not exist", study.study.scene),
                           "a scene file, by its path from the study file's folder",
                           missing ? std::string{} : missing.error().suggestion);
  }
  auto read = scene::read_scene(path);
  if (!read) return read.error();
  study.scene = std::move(*read);
  return std::nullopt;
}

/// One override of [set], and those of the tables in it.
Fault apply_override(const toml::node& node, const std::string& name, StudyFile& study, ChangedScene& scene) {
  const Place place = scene::place_of(node, study.file);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, inner] : *table) {
      const std::string dotted = name.empty() ? std::string(key.str()) : name + "." + std::string(key.str());
      if (Fault fault = apply_override(inner, dotted, study, scene)) return fault;
    }
    return std::nullopt;
  }
  const auto key = scene::describe_key(study.scene, name, place);
  if (!key) return in_table(key.error(), "set");
  const auto value = scene::read_value(node, *key, study.file);
  if (!value) return in_table(value.error(), "set");
  study.overrides[name] = scene::format_value(*key, *value);
  scene.apply({name, *value, study.overrides[name], "set." + name, place});
  return std::nullopt;
}

Fault apply_overrides(const toml::table& root, StudyFile& study) {
  const toml::node* node = root.get("set");
  if (!node) return std::nullopt;
  if (!node->is_table()) {
    return scene::error_at(scene::place_of(*node, study.file), "set", scene::found_text(*node),
                           "a table, written [set], of scene keys");
  }
  ChangedScene scene(study.scene);
  if (Fault fault = apply_override(*node, "", study, scene)) return fault;
  if (!scene.complete()) return scene.error();
  study.scene = scene.take();
  return std::nullopt;
}

/// A scene accepts the values that stand in it: where the study gives a key others, it has to accept them
/// itself.
void drop_acceptances_of_other_values(StudyFile& study) {
  std::set<std::string> changed;
  for (const auto& [key, value] : study.overrides) changed.insert(key);
  for (const Axis& axis : study.study.axes) changed.insert(axis.key.name);
  // A reason for how the charge is held, or for all that is foreign, was given of the scene's own interfaces.
  std::set<std::string> dropped = changed;
  for (const std::string& key : changed) {
    if (!key.starts_with("interface.")) continue;
    dropped.insert(scene::foreign_calibration);
    for (const auto& other : scene::interface_keys())
      dropped.insert(key.substr(0, key.rfind('.') + 1) + other.name);
  }
  std::erase_if(study.scene.scene.accepted, [&](const auto& each) { return dropped.contains(each.key); });
}

/// The acceptances of the study: those of scene keys go to its scene, those of its own keys beside what it
/// states. Needs the overrides and what varies.
Fault read_accepted(const toml::table& root, const StudyKeys& keys, StudyFile& study) {
  drop_acceptances_of_other_values(study);
  std::vector<std::string> known = scene::acceptable_names(study.scene.scene);
  for (const auto& key : keys) known.push_back(key.name);
  auto accepted = scene::read_acceptances(root, known, study.file);
  if (!accepted) return accepted.error();
  for (const auto& key : keys) {
    const scene::Value value = key.get(study.study);
    if (!study.places.contains(key.name) || scene::is_plausible(key, value)) continue;
    study.study.implausible.push_back({key.name, scene::format_value(key, value), scene::plausible_text(key),
                                       scene::reason_for(*accepted, key.name)});
  }
  for (scene::Acceptance& each : *accepted) {
    // "calibration" accepts all that is foreign to it, whatever record the study's key of that name names.
    if (each.key == scene::foreign_calibration || !scene::find_key(keys, each.key))
      scene::accept(study.scene.scene.accepted, std::move(each));
  }
  return std::nullopt;
}

Fault check_scene(const StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  if (!scene::has_charge(scene))
    return fault_at(study, "scene", "a scene without a charge", "a scene with a charge");
  if (!study.study.kind.own_scenes && study.study.early_time > scene.load.duration) {
    return fault_at(
        study, "early_time", scene::format_quantity(study.study.early_time, Dimension::time),
        "a time within the load's duration, " + scene::format_quantity(scene.load.duration, Dimension::time));
  }
  return std::nullopt;
}

/// The scene that the cases start from: as written, then [set], then the constants of a calibration, then the
/// numerics that a tolerance picks from an accuracy record.
Fault settle_scene(const StudySource& source, const std::optional<double>& tolerance, StudyFile& study,
                   std::optional<AccuracyRecord>& record) {
  if (Fault fault = read_scene_of(study, source.folder)) return fault;
  if (Fault fault = apply_overrides(source.root, study)) return fault;
  if (Fault fault = use_calibration(study, source.folder)) return fault;
  if (Fault fault = read_model_form(study, source.folder)) return fault;
  auto read = read_record(study, source.folder);
  if (!read) return read.error();
  record = std::move(*read);
  const double wanted = tolerance.value_or(study.study.setting_tolerance);
  if (std::isfinite(wanted)) {
    if (Fault fault = choose_setting(study, record, wanted)) return fault;
  }
  return check_scene(study);
}

/// What varies, and the cases that follow.
Fault settle_cases(const StudySource& source, const Kind& kind, const StudyKeys& keys, StudyFile& study) {
  if (Fault fault = kind.read(source, study)) return fault;
  if (Fault fault = check_load_axes(study)) return fault;
  if (Fault fault = read_accepted(source.root, keys, study)) return fault;
  if (Fault fault = settle_gaps(study)) return fault;
  return kind.make_cases(source, study);
}

/// People do not number the tables of a study: "input.0.range" is input.range to them.
InputError unnumbered(InputError error, const std::string& file) {
  if (error.file != file) return error;
  const std::size_t first = error.key.find('.');
  const std::size_t second = first == std::string::npos ? first : error.key.find('.', first + 1);
  if (second == std::string::npos) return error;
  const std::string_view part = std::string_view(error.key).substr(first + 1, second - first - 1);
  const bool number = !part.empty() && std::all_of(part.begin(), part.end(), [](unsigned char character) {
    return std::isdigit(character) != 0;
  });
  if (number) error.key.erase(first, second - first);
  return error;
}

}  // namespace

scene::Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& path,
                                       const StudyRequest& request) {
  const auto table = scene::parse_toml(text, path.string());
  if (!table) return table.error();
  const StudySource source{*table, path.parent_path()};
  StudyFile study;
  study.file = path.string();
  study.most_cases = request.most_cases;
  const auto kind = read_kind(*table, study.file);
  if (!kind) return kind.error();
  if (Fault fault = check_kind(*table, **kind, study.file)) return *fault;
  const StudyKeys keys = joined({common_keys(), (*kind)->keys});
  if (Fault fault = read_keys(*table, **kind, keys, study)) return *fault;
  std::optional<AccuracyRecord> record;
  if (Fault fault = settle_scene(source, request.tolerance, study, record))
    return unnumbered(*fault, study.file);
  if (Fault fault = settle_cases(source, **kind, keys, study)) return unnumbered(*fault, study.file);
  if (!study.study.kind.own_scenes) settle_uncertainty(study, record);
  if (study.study.title.empty()) study.study.title = study.scene.scene.title;
  return study;
}

scene::Expected<StudyFile> read_study(const std::filesystem::path& file, const StudyRequest& request) {
  const auto text = scene::read_text_file(file);
  if (!text) return text.error();
  return parse_study(*text, file, request);
}

namespace {

/// " (kind critical-gap, sweep)": the kinds that have a key.
std::string kinds_text(const std::string& name) {
  return fmt::format(" (kind {})", fmt::join(kinds_with(name), ", "));
}

}  // namespace

std::vector<scene::DocumentedKey> describe_study_keys() {
  std::vector<scene::DocumentedKey> documented;
  std::set<std::string> known;
  const auto add = [&](scene::DocumentedKey key, const std::string& owner) {
    if (!known.insert(key.description.name).second) return;
    if (!owner.empty()) key.description.sentence += kinds_text(owner);
    documented.push_back(std::move(key));
  };
  for (const auto& key : common_keys()) add({key, default_text(key, key.default_value())}, {});
  for (const Kind& kind : kinds()) {
    for (const auto& key : kind.keys) add({key, default_text(key, key.default_value())}, key.name);
  }
  for (const Kind& kind : kinds()) {
    for (const StudyTable& table : kind.tables) {
      for (const scene::DocumentedKey& key : table.keys) add(key, table.name);
    }
  }
  for (scene::DocumentedKey& key : table_of("accept", scene::acceptance_keys()).keys) add(std::move(key), {});
  return documented;
}

}  // namespace launchsafe::kinds
