#include "launchsafe/kinds/kind.hpp"
#include "study_keys.hpp"

#include <regex>

namespace launchsafe::kinds {
namespace {

using scene::InputError;

void apply_overrides(const OverrideTable& overrides, StudyFile& study) {
  const std::string written = fmt::format("a table, written [{}], of scene keys", overrides.name);
  const auto changes = taken(changes_in(overrides, study.file, written, study.scene));
  for (const Change& each : changes) study.overrides[each.name] = text_of(study.scene, each);
  study.scene = taken(with_changes(study.scene, changes));
}

void check_scene(const StudyFile& study) {
  const Scene& scene = study.scene.scene;
  if (!scene::has_charge(scene))
    refuse_at(study, "scene", "a scene without a charge", "a scene with a charge");
  if (!study.study.kind.own_scenes && study.study.early_time > scene::end_time(scene.load))
    refuse_at(study, "early_time", format_quantity(study.study.early_time, Dimension::time),
              "a time within the load's duration, " +
                  format_quantity(scene::end_time(scene.load), Dimension::time));
}

/// Whether a kind has a key or a table of that name for itself.
bool has(const Kind& kind, const std::string& name) {
  return scene::find_key(kind.keys, name) != nullptr ||
         std::ranges::any_of(kind.tables, [&](const StudyTable& table) { return table.name == name; });
}

std::vector<std::string> kinds_with(const std::string& name) {
  std::vector<std::string> names;
  for (const Kind& kind : kinds())
    if (has(kind, name)) names.push_back(kind.traits.name);
  return names;
}

/// The tables of all study files that are read apart from the keys.
std::vector<std::string> common_tables() { return {"set"}; }

/// The kind that a study file names. Where it names none, a key that no kind has is the first fault.
const Kind& read_kind(const toml::table& root, const std::string& file) {
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
    scene::read_described(root, scene::descriptions_of(keys), tables,
                          file);  // which throws: "kind" is missing
    throw error_at({file}, "kind", "nothing; the key is missing", "a kind of study");
  }
  return kind_named(
      std::get<std::string>(scene::read_value(*node, *scene::find_key(common_keys(), "kind"), file)));
}

/// The keys of the file, and the tables that are read apart from the keys.
std::vector<Leaf> names_in(const toml::table& root) {
  std::vector<Leaf> names;
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    const toml::table* table = node.as_table();
    if (table == nullptr || !kinds_with(name).empty()) {
      names.push_back({name, &node});
      continue;
    }
    for (const Leaf& leaf : study::leaves_as_written(*table))
      names.push_back({name + "." + leaf.name, leaf.node});
  }
  return names;
}

/// The first key or table of another kind, which would silently do nothing.
void check_kind(const toml::table& root, const Kind& kind, const std::string& file) {
  std::vector<Leaf> others = names_in(root);
  std::erase_if(others,
                [&](const auto& each) { return kinds_with(each.name).empty() || has(kind, each.name); });
  if (others.empty()) return;
  const Leaf first =
      std::ranges::min(others, {}, [](const Leaf& each) { return each.node->source().begin.line; });
  throw error_at(scene::place_of(*first.node, file), first.name,
                 "a key of kind " + scene::quoted_list(kinds_with(first.name)),
                 "keys of kind \"" + kind.traits.name + '"');
}

void read_keys(const toml::table& root, const Kind& kind, const StudyKeys& keys, StudyFile& study) {
  std::vector<std::string> tables = common_tables();
  for (const StudyTable& table : kind.tables) tables.push_back(table.name);
  study.places = scene::read_table(root, keys, tables, study.file, study.study);
  check_reasons(study);
  for (const std::string& name : tables)
    if (const toml::node* node = root.get(name)) study.places[name] = scene::place_of(*node, study.file);
  check_twice(study, "gaps", Dimension::length, study.study.gaps);
}

void settle_cases(const StudySource& source, const Kind& kind, StudyFile& study) {
  if (kind.varies.values || kind.varies.distributions) read_vary(source, kind.varies, study);
  check_load_axes(study);
  check_constants(study);
  settle_gaps(study);
  kind.make_cases(source, study);
  // Labels have six digits; cases that they do not tell apart are numbered.
  std::unordered_map<std::string, int> seen;
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    if (const int before = seen[study.cases.label(i)]++; before > 0)
      study.cases.relabel(i, fmt::format("{} ({})", study.cases.label(i), before + 1));
}

/// A fault as people are told of it, who do not number the tables of a study: "vary.0.range" is vary.range to
/// them.
InputError told(InputError error, const std::string& file) {
  static const std::regex numbered(R"(^([^.]*)\.[0-9]+(\..*)$)");
  if (error.file == file) error.key = std::regex_replace(error.key, numbered, "$1$2");
  return error;
}

}  // namespace

Expected<std::vector<Change>> changes_in(const OverrideTable& table, const std::string& file,
                                         const std::string& written, const SceneFile& scene) {
  const auto& [name, node] = table;
  std::vector<Change> changes;
  if (!node) return changes;
  if (!node->is_table()) throw error_at(scene::place_of(*node, file), name, found_text(*node), written);
  for (const Leaf& leaf : study::leaves_as_written(*node->as_table())) {
    const Place place = scene::place_of(*leaf.node, file);
    const auto key = scene::within(name, [&] { return scene::describe_key(scene, leaf.name, place); });
    const auto value = scene::caught(
        [&] { return scene::within(name, [&] { return scene::read_value(*leaf.node, key, file); }); });
    if (!value) return value.error();
    changes.push_back({leaf.name, *value, place, name + "." + leaf.name});
  }
  return changes;
}

void settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides, StudyFile& study) {
  study.scene = scene::read_scene(scene::named_file(source.folder, study.study.scene,
                                                    place_of_key(study, "scene"), "scene", "a scene file"));
  use_constants(study, source.folder);
  for (const OverrideTable& each : overrides) apply_overrides(each, study);
  if (study.study.kind.gives_verdicts) scene::check_expected_velocity(study.scene);
  read_models(study, source.folder);
  check_scene(study);
}

Expected<StudyFile> parse_study(std::string_view text, const std::filesystem::path& path,
                                const StudyRequest& request) try {
  const toml::table root = scene::parse_toml(text, path.string());
  const StudySource source{root, path.parent_path()};
  StudyFile study;
  study.file = path.string();
  study.most_cases = request.most_cases;
  scene::check_content(root, study.file, scene::InputContent::study);
  const Kind& kind = read_kind(root, study.file);
  const StudyKeys keys = joined({common_keys(), kind.keys});
  check_kind(root, kind, study.file);
  read_keys(root, kind, keys, study);
  settle_scene(source, {{"set", root.get("set")}}, study);
  settle_cases(source, kind, study);
  check_models(study);
  if (study.study.title.empty()) study.study.title = study.scene.scene.title;
  return study;
} catch (const InputError& error) {
  return told(error, path.string());
}

Expected<StudyFile> read_study(const std::filesystem::path& file, const StudyRequest& request) {
  const auto text = scene::caught([&] { return scene::read_text_file(file); });
  return text ? parse_study(*text, file, request) : text.error();
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
  for (const Kind& kind : kinds())
    for (const auto& key : kind.keys) add({key, default_text(key, key.default_value())}, key.name);
  for (const Kind& kind : kinds())
    for (const StudyTable& table : kind.tables)
      for (const scene::DocumentedKey& key : table.keys) add(key, table.name);
  return documented;
}

}  // namespace launchsafe::kinds
