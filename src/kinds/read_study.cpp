#include "launchsafe/kinds/read_study.hpp"

#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <unordered_map>

namespace launchsafe::kinds {

using study::Fault, study::StudyFile;

namespace {

using scene::Dimension, scene::InputError, scene::Place;

/// One override of a table.
Fault add_override(const study::Leaf& leaf, const std::string& table_name, StudyFile& study,
                   std::vector<study::Change>& changes) {
  const Place place = scene::place_of(*leaf.node, study.file);
  const auto key = scene::describe_key(study.scene, leaf.name, place);
  if (!key) return scene::within(table_name, key.error());
  const auto value = scene::read_value(*leaf.node, *key, study.file);
  if (!value) return scene::within(table_name, value.error());
  if (auto note = scene::note_on_former_word(*leaf.node, *key, place))
    study.scene.notes.push_back(std::move(*note));
  study.overrides[leaf.name] = scene::format_value(*key, *value);
  changes.push_back({leaf.name, *value, study.overrides[leaf.name], table_name + "." + leaf.name, place});
  return std::nullopt;
}

Fault apply_overrides(const OverrideTable& overrides, StudyFile& study) {
  if (!overrides.node) return std::nullopt;
  if (!overrides.node->is_table()) {
    return scene::error_at(scene::place_of(*overrides.node, study.file), overrides.name,
                           scene::found_text(*overrides.node),
                           fmt::format("a table, written [{}], of scene keys", overrides.name));
  }
  std::vector<study::Change> changes;
  for (const study::Leaf& leaf : study::leaves_as_written(*overrides.node->as_table()))
    if (Fault fault = add_override(leaf, overrides.name, study, changes)) return fault;
  const bool may_close = study.study.kind.closing_gaps != study::ClosingGaps::refused;
  auto changed = with_changes(study.scene, changes, may_close);
  if (!changed) return changed.error();
  study.scene = std::move(*changed);
  return std::nullopt;
}

Fault check_scene(const StudyFile& study) {
  const scene::Scene& scene = study.scene.scene;
  if (!scene::has_charge(scene))
    return fault_at(study, "scene", "a scene without a charge", "a scene with a charge");
  if (scene.surface.model == scene::GapModel::closing &&
      study.study.kind.closing_gaps == study::ClosingGaps::refused)
    return fault_at(study, "scene", "a scene whose gap closes", study::only_reservoir);
  if (!study.study.kind.own_scenes && study.study.early_time > scene::end_time(scene.load)) {
    return fault_at(study, "early_time", scene::format_quantity(study.study.early_time, Dimension::time),
                    "a time within the load's duration, " +
                        scene::format_quantity(scene::end_time(scene.load), Dimension::time));
  }
  return std::nullopt;
}

/// Whether a kind has a key or a table of that name for itself.
bool has(const Kind& kind, const std::string& name) {
  return scene::find_key(kind.keys, name) != nullptr ||
         std::ranges::any_of(kind.tables, [&](const StudyTable& table) { return table.name == name; });
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

/// What study files of earlier versions said, and how that is written now.
struct FormerKey {
  std::string_view name, now;
  std::string_view kind = {};  ///< where another one has such a key still
};
constexpr FormerKey former_keys[] = {
    {"axes", "a [[vary]] with key and values for each axis, and gaps for gap"},
    {"peak_pressures", "a [[vary]] with key = \"peak_pressure\" and values"},
    {"crack_radii", "a [[vary]] with key = \"crack_radius\" and values"},
    {"flaw_sizes", "a [[vary]] with key = \"flaw_size\" and values"},
    {"input", "a [[vary]] with the same keys for each input"},
    {"gap", "gaps, in every kind of study"},
    {"variant", "one [[vary]], and [[vary.variants]] for each variant", "comparison"},
};

Fault check_former(const toml::table& root, const std::string& file) {
  const toml::node* kind = root.get("kind");
  const std::string name = kind == nullptr ? std::string{} : kind->value_or(std::string{});
  if (name == "sweep")
    return scene::error_at(scene::place_of(*kind, file), "kind", "\"sweep\", which is critical-gap now",
                           "kind \"critical-gap\", with a [[vary]] with key and values for each axis",
                           "kind = \"critical-gap\"");
  for (const FormerKey& former : former_keys)
    if (const toml::node* node = root.get(former.name);
        node != nullptr && (former.kind.empty() || former.kind == name))
      return scene::error_at(scene::place_of(*node, file), former.name, "a key of an earlier version",
                             former.now);
  return std::nullopt;
}

/// The kind that a study file names. Where it names none, a key that no kind has is the first fault.
scene::Expected<const Kind*> read_kind(const toml::table& root, const std::string& file) {
  const toml::node* node = root.get("kind");
  if (!node) {
    StudyKeys keys = common_keys();
    std::vector<std::string> tables = common_tables();
    // With every key and every table that some kind has.
    for (const Kind& kind : kinds()) {
      for (const auto& key : kind.keys)
        if (scene::find_key(keys, key.name) == nullptr) keys.push_back(key);
      for (const StudyTable& table : kind.tables)
        if (std::ranges::find(tables, table.name) == tables.end()) tables.push_back(table.name);
    }
    return scene::read_described(root, scene::descriptions_of(keys), tables, file).error();
  }
  const auto value = scene::read_value(*node, *scene::find_key(common_keys(), "kind"), file);
  if (!value) return value.error();
  return &kind_named(std::get<std::string>(*value));
}

/// The keys of the file, and the tables that are read apart from the keys.
std::vector<study::Leaf> names_in(const toml::table& root) {
  std::vector<study::Leaf> names;
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    const toml::table* table = node.as_table();
    if (table == nullptr || !kinds_with(name).empty()) {
      names.push_back({name, &node});
      continue;
    }
    for (const study::Leaf& leaf : study::leaves_as_written(*table))
      names.push_back({name + "." + leaf.name, leaf.node});
  }
  return names;
}

/// The first key or table of another kind, which would silently do nothing.
Fault check_kind(const toml::table& root, const Kind& kind, const std::string& file) {
  const study::Leaf* first = nullptr;
  const std::vector<study::Leaf> names = names_in(root);
  for (const study::Leaf& each : names) {
    if (kinds_with(each.name).empty() || has(kind, each.name)) continue;
    if (!first || each.node->source().begin.line < first->node->source().begin.line) first = &each;
  }
  if (!first) return std::nullopt;
  return scene::error_at(scene::place_of(*first->node, file), first->name,
                         "a key of kind " + scene::quoted_list(kinds_with(first->name)),
                         "keys of kind \"" + kind.traits.name + '"');
}

/// The keys of the study file, with their places.
Fault read_keys(const toml::table& root, const Kind& kind, const StudyKeys& keys, StudyFile& study) {
  std::vector<std::string> tables = common_tables();
  for (const StudyTable& table : kind.tables) tables.push_back(table.name);
  auto read = scene::read_table(root, keys, tables, study.file, study.study);
  if (!read) return read.error();
  study.places = std::move(*read);
  if (Fault fault = check_stated_uncertainties(keys, study)) return fault;
  for (const std::string& name : tables) {
    if (const toml::node* node = root.get(name)) study.places[name] = scene::place_of(*node, study.file);
  }
  return check_twice(study, "gaps", Dimension::length, study.study.gaps);
}

/// What varies, and the cases that follow.
Fault settle_cases(const StudySource& source, const Kind& kind, const StudyKeys& keys, StudyFile& study) {
  if (kind.read != nullptr)
    if (Fault fault = kind.read(source, study)) return fault;
  if (kind.varies.values || kind.varies.distributions)
    if (Fault fault = read_vary(source, kind.varies, study)) return fault;
  if (Fault fault = check_load_axes(study)) return fault;
  if (Fault fault = settle_acceptances(source.root, keys, study)) return fault;
  if (Fault fault = settle_gaps(study)) return fault;
  if (Fault fault = kind.make_cases(source, study)) return fault;
  // Labels have six digits; cases that they do not tell apart are numbered.
  std::unordered_map<std::string, int> seen;
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    if (const int before = seen[study.cases.label(i)]++; before > 0)
      study.cases.relabel(i, fmt::format("{} ({})", study.cases.label(i), before + 1));
  return std::nullopt;
}

/// People do not number the tables of a study: "vary.0.range" is vary.range to them.
InputError unnumbered(InputError error, const std::string& file) {
  static const std::regex numbered(R"(^([^.]*)\.[0-9]+(\..*)$)");
  if (error.file == file) error.key = std::regex_replace(error.key, numbered, "$1$2");
  return error;
}

}  // namespace

scene::Expected<scene::SceneFile> read_named_scene(const std::string& name,
                                                   const std::filesystem::path& folder,
                                                   const std::string& key, const Place& place) {
  const std::filesystem::path path = folder / name;
  std::error_code status;
  if (std::filesystem::exists(path, status)) return scene::read_scene(path);
  const auto missing = scene::read_text_file(path);
  return scene::error_at(place, key, fmt::format("\"{}\", which does not exist", name),
                         "a scene file, by its path from the study file's folder",
                         missing ? std::string{} : missing.error().suggestion);
}

Fault settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides, StudyFile& study,
                   study::AccuracyRecords& records) {
  auto scene = read_named_scene(study.study.scene, source.folder, "scene", place_of_key(study, "scene"));
  if (!scene) return scene.error();
  study.scene = std::move(*scene);
  for (const OverrideTable& each : overrides) {
    if (Fault fault = apply_overrides(each, study)) return fault;
  }
  if (Fault fault = use_calibration(study, source.folder)) return fault;
  if (Fault fault = scene::check_expected_velocity(study.scene)) return fault;
  if (Fault fault = read_model_form(study, source.folder)) return fault;
  auto read = read_records(study, source.folder);
  if (!read) return read.error();
  records = std::move(*read);
  const double wanted = source.tolerance.value_or(study.study.setting_tolerance);
  if (std::isfinite(wanted)) {
    if (Fault fault = choose_setting(study, records, wanted)) return fault;
  }
  return check_scene(study);
}

Fault settle_acceptances(const toml::table& root, const StudyKeys& keys, StudyFile& study) {
  std::vector<scene::KeyDescription> known = scene::acceptable_keys(study.scene.scene);
  known.insert(known.end(), keys.begin(), keys.end());
  auto accepted = scene::read_acceptances(root, known, study.file);
  if (!accepted) return accepted.error();
  for (const auto& key : keys) {
    const scene::Value value = key.get(study.study);
    if (!study.places.contains(key.name) || scene::is_plausible(key, value)) continue;
    study.study.implausible.push_back(
        scene::implausible(*accepted, key, key.name, value, scene::plausible_text(key)));
  }
  for (scene::Acceptance& each : *accepted)
    if (!scene::find_key(keys, each.key)) scene::accept(study.scene.scene.accepted, std::move(each));
  return std::nullopt;
}

scene::Expected<StudyFile> read_study_table(const StudySource& source, const std::string& file,
                                            std::size_t most_cases) {
  StudyFile study;
  study.file = file;
  study.most_cases = most_cases;
  if (Fault fault = scene::check_content(source.root, study.file, scene::InputContent::study)) return *fault;
  if (Fault fault = check_former(source.root, study.file)) return *fault;
  const auto kind = read_kind(source.root, study.file);
  if (!kind) return kind.error();
  const StudyKeys keys = joined({common_keys(), (*kind)->keys});
  if (Fault fault = check_bare_uncertainties(source.root, keys, study.file)) return *fault;
  if (Fault fault = check_kind(source.root, **kind, study.file)) return *fault;
  if (Fault fault = read_keys(source.root, **kind, keys, study)) return *fault;
  study::AccuracyRecords records;
  if (Fault fault = settle_scene(source, {{"set", source.root.get("set")}}, study, records))
    return unnumbered(*fault, study.file);
  if (Fault fault = settle_cases(source, **kind, keys, study)) return unnumbered(*fault, study.file);
  if (!study.study.kind.own_scenes) settle_uncertainty(study, records);
  if (study.study.title.empty()) study.study.title = study.scene.scene.title;
  return study;
}

scene::Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& path,
                                       const StudyRequest& request) {
  const auto table = scene::parse_toml(text, path.string());
  if (!table) return table.error();
  return read_study_table({*table, text, path.parent_path(), request.tolerance}, path.string(),
                          request.most_cases);
}

scene::Expected<StudyFile> read_study(const std::filesystem::path& file, const StudyRequest& request) {
  const auto text = scene::read_text_file(file);
  if (!text) return text.error();
  return parse_study(*text, file, request);
}

std::vector<scene::DocumentedKey> describe_study_keys() {
  std::vector<scene::DocumentedKey> documented;
  std::set<std::string> known;
  const auto add = [&](scene::DocumentedKey key, const std::string& owner) {
    if (!known.insert(key.description.name).second) return;
    if (!owner.empty())
      key.description.sentence += fmt::format(" (kind {})", fmt::join(kinds_with(owner), ", "));
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
  for (scene::DocumentedKey& key : study_table_of("accept", scene::acceptance_keys()).keys)
    add(std::move(key), {});
  return documented;
}

}  // namespace launchsafe::kinds
