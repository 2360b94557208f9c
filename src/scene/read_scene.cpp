#include "launchsafe/scene/read_scene.hpp"

#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/pressure_curve.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace launchsafe::scene {
namespace {

const std::vector<std::string> tables_read_apart{"body", "observation_point", "accept", "interface"};

/// Reads [[name]] tables into `owners`; the places become "name.<name of the owner>.<key>".
template <class Owner>
std::optional<InputError> read_named(const toml::table& root, const std::string& name,
                                     const std::vector<Key<Owner>>& keys, const std::string& file,
                                     std::vector<Owner>& owners, std::map<std::string, Place>& places) {
  auto tables = read_tables(root, name, keys, file, fmt::format("tables, each written [[{}]]", name));
  if (!tables) return tables.error();
  for (auto& [owner, own_places] : *tables) {
    // Of two with one name the second one's place stands: that is the one to complain about.
    for (auto& [key, place] : own_places)
      places.insert_or_assign(fmt::format("{}.{}.{}", name, owner.name, key), std::move(place));
    owners.push_back(std::move(owner));
  }
  return std::nullopt;
}

std::optional<InputError> read_curve_file(SceneFile& file) {
  Load& load = file.scene.load;
  if (load.curve_file.empty()) return std::nullopt;
  const std::filesystem::path path = file.folder / load.curve_file;
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    const auto missing = read_text_file(path);
    const auto given = file.given.find("load.curve");
    const Place place = given == file.given.end() ? Place{file.file} : given->second.place;
    return error_at(place, "load.curve", fmt::format("\"{}\", which does not exist", load.curve_file),
                    "a CSV file, by its path from the scene file's folder",
                    missing ? std::string{} : missing.error().suggestion);
  }
  auto curve = read_pressure_curve(path);
  if (!curve) return curve.error();
  load.curve_time = std::move(curve->time);
  load.curve_pressure = std::move(curve->pressure);
  return std::nullopt;
}

/// The scene from its bodies, its points and the given keys, applied in the order of their declaration. The
/// file of a measured curve is read unless the scene has it already.
std::optional<InputError> rebuild(SceneFile& file, bool has_curve) {
  Scene fresh;
  fresh.bodies = std::move(file.scene.bodies);
  fresh.output.observation_points = std::move(file.scene.output.observation_points);
  fresh.accepted = std::move(file.scene.accepted);
  fresh.interfaces = std::move(file.scene.interfaces);
  for (const Key<Scene>& key : scene_keys()) {
    const auto given = file.given.find(key.name);
    if (given != file.given.end()) key.set(fresh, given->second.value);
  }
  std::swap(file.scene, fresh);
  if (has_curve && !file.scene.load.curve_file.empty()) {
    file.scene.load.curve_time = std::move(fresh.load.curve_time);
    file.scene.load.curve_pressure = std::move(fresh.load.curve_pressure);
  } else if (auto error = read_curve_file(file)) {
    return error;
  }
  return validate(file);
}

/// The interface of a body; a bonded one where the scene says nothing of it.
Interface& interface_of(Scene& scene, const std::string& body) {
  for (Interface& faces : scene.interfaces)
    if (faces.body == body) return faces;
  return scene.interfaces.emplace_back(Interface{.body = body});
}
const Interface& interface_of(const Scene& scene, const std::string& body) {
  static const Interface bonded{};
  for (const Interface& faces : scene.interfaces)
    if (faces.body == body) return faces;
  return bonded;
}

/// The key, which takes back the friction of faces that slid where it makes them bonded.
Key<Scene> with_friction_only_where_used(Key<Scene> key, const std::string& body) {
  key.set = [set = std::move(key.set), body](Scene& scene, const Value& value) {
    const bool slid = interface_of(scene, body).condition == Condition::sliding;
    set(scene, value);
    Interface& faces = interface_of(scene, body);
    if (slid && faces.condition == Condition::bonded) faces.friction.reset();
  };
  return key;
}

/// Keys of the scene's bodies that say where they lie, "body.<name>.x" and ".r", and of the interfaces of all
/// bodies that touch the charge, "interface.<name>.<key>".
std::vector<Key<Scene>> keys_of_tables(const Scene& scene) {
  std::vector<Key<Scene>> all;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (Key<Scene>& key : keys::keys_of_part<Scene>(
             "body." + scene.bodies[i].name + ".", [i](auto& owner) -> auto& { return owner.bodies[i]; },
             body_keys()))
      if (key.kind == KeyKind::range) all.push_back(std::move(key));
  for (const std::string& body : bodies_at_the_charge(scene))
    for (Key<Scene>& key : keys::keys_of_part<Scene>(
             "interface." + body + ".", [body](auto& owner) -> auto& { return interface_of(owner, body); },
             interface_keys()))
      all.push_back(with_friction_only_where_used(std::move(key), body));
  return all;
}

std::vector<std::string> names_of_keys(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& keys : {scene_keys(), keys_of_tables(scene)})
    for (const Key<Scene>& key : keys) names.push_back(key.name);
  return names;
}

Expected<Key<Scene>> key_named(const Scene& scene, const std::string& name, const Place& place) {
  if (const Key<Scene>* key = find_key(scene_keys(), name)) return *key;
  const std::vector<Key<Scene>> of_tables = keys_of_tables(scene);
  if (const Key<Scene>* key = find_key(of_tables, name)) return *key;
  return unknown_key(place, name, names_of_keys(scene));
}

}  // namespace

Expected<SceneFile> parse_scene(std::string_view text, const std::filesystem::path& path) {
  const auto table = parse_toml(text, path.string());
  if (!table) return table.error();
  SceneFile file;
  file.file = path.string();
  file.folder = path.parent_path();
  Scene& scene = file.scene;
  // Faults of the keys first, then of the tables; within each by line.
  auto read = read_described(*table, descriptions_of(scene_keys()), tables_read_apart, file.file);
  if (!read) return read.error();
  file.notes = std::move(read->notes);
  for (auto& [index, value] : read->values) {
    const std::string& name = scene_keys()[index].name;
    file.given[name] = {read->places[name], std::move(value)};
  }
  if (auto error = read_named(*table, "body", body_keys(), file.file, scene.bodies, file.places))
    return *error;
  if (auto error = read_named(*table, "observation_point", observation_point_keys(), file.file,
                              scene.output.observation_points, file.places)) {
    return *error;
  }
  auto interfaces = read_interfaces(*table, file.file, file.places);
  if (!interfaces) return interfaces.error();
  scene.interfaces = std::move(*interfaces);
  auto accepted = read_acceptances(*table, acceptable_names(scene), file.file);
  if (!accepted) return accepted.error();
  scene.accepted = std::move(*accepted);
  if (auto error = rebuild(file, false)) return *error;
  return file;
}

Expected<SceneFile> read_scene(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  return parse_scene(*text, file);
}

Expected<KeyDescription> describe_key(const SceneFile& file, const std::string& name, const Place& place) {
  const auto key = key_named(file.scene, name, place);
  if (!key) return key.error();
  return KeyDescription(*key);
}

Value value_in(const SceneFile& file, const std::string& name) {
  const auto key = key_named(file.scene, name, {});
  assert(key);
  return key->get(file.scene);
}

Expected<SceneFile> with_keys(const SceneFile& file, const std::vector<KeyChange>& changes) {
  SceneFile changed = file;
  bool other_curve = false;
  for (const auto& [name, value, place] : changes) {
    const auto key = key_named(file.scene, name, place);
    if (!key) return key.error();
    if (find_key(scene_keys(), name) == nullptr) {
      key->set(changed.scene, value);
      changed.places[name] = place;
      continue;
    }
    for (const std::string& overridden : key->overrides) changed.given.erase(overridden);
    changed.given[name] = {place, value};
    other_curve = other_curve || name == "load.curve";
  }
  if (auto error = rebuild(changed, !other_curve)) return *error;
  return changed;
}

Expected<SceneFile> with_key(const SceneFile& file, const std::string& name, const Value& value,
                             const Place& place) {
  return with_keys(file, {{name, value, place}});
}

Expected<SceneFile> with_written_key(const SceneFile& file, const std::string& name, std::string_view written,
                                     const Place& place) {
  const auto description = describe_key(file, name, place);
  if (!description) return description.error();
  const auto value = parse_value(written, *description, place);
  if (!value) return value.error();
  return with_key(file, name, *value, place);
}

std::vector<ListedKey> list_keys(const SceneFile& file) {
  std::vector<ListedKey> listed;
  for (const Key<Scene>& key : scene_keys()) {
    const auto given = file.given.find(key.name);
    const bool is_given = given != file.given.end();
    listed.push_back({key.name, format_value(key, key.get(file.scene)),
                      is_given ? Standing::input : key.standing, key.sentence,
                      is_given ? given->second.place : Place{}});
  }
  return listed;
}

namespace {

template <class Owner>
std::string inline_tables(std::string_view name, const std::vector<Key<Owner>>& keys,
                          const std::vector<Owner>& owners) {
  std::string text = fmt::format("{} = [\n", name);
  for (const Owner& owner : owners) {
    std::string_view before = "  { ";
    for (const Key<Owner>& key : keys) {
      text += fmt::format("{}{} = {}", before, key.name, exact_toml(key, key.get(owner)));
      before = ", ";
    }
    text += " },\n";
  }
  return text + "]\n";
}

/// Materials under other names than their law's, which only programs make. Files cannot declare them, but
/// texts of different scenes differ.
std::string own_materials(const Scene& scene) {
  std::string text;
  for (const Material& material : scene.materials) {
    std::visit(
        [&]<class Law>(const Law& law) {
          if (material.name == Law::name) return;
          text += fmt::format("material.\"{}\".law = '{}'\n", material.name, Law::name);
          for (const Key<Law>& key : Law::parameters())
            text += fmt::format("material.\"{}\".{} = {}\n", material.name, key.name,
                                exact_toml(key, key.get(law)));
        },
        material.law);
  }
  return text;
}

}  // namespace

std::string to_toml(const Scene& scene) {
  std::string text;
  for (const Key<Scene>& key : scene_keys())
    if (!key.is_written || key.is_written(scene))
      text += fmt::format("{} = {}\n", key.name, exact_toml(key, key.get(scene)));
  text += own_materials(scene) + interfaces_as_toml(scene.interfaces) +
          inline_tables("body", body_keys(), scene.bodies) +
          inline_tables("observation_point", observation_point_keys(), scene.output.observation_points);
  return scene.accepted.empty() ? text : text + inline_tables("accept", acceptance_keys(), scene.accepted);
}

}  // namespace launchsafe::scene
