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

/// "body.<name>.<key>" taken apart.
struct BodyKey {
  std::size_t body = 0;
  const Key<Body>* key = nullptr;
};

std::optional<BodyKey> find_body_key(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string prefix = "body." + scene.bodies[i].name + ".";
    if (!name.starts_with(prefix)) continue;
    const Key<Body>* key = find_key(body_keys(), name.substr(prefix.size()));
    if (key && key->kind == KeyKind::range) return BodyKey{i, key};
  }
  return std::nullopt;
}

/// "interface.<name>.<key>" taken apart, of a body that touches the charge.
struct InterfaceKey {
  std::string body;
  const Key<Interface>* key = nullptr;
};

std::optional<InterfaceKey> find_interface_key(const Scene& scene, const std::string& name) {
  for (const std::string& body : bodies_at_the_charge(scene)) {
    const std::string prefix = "interface." + body + ".";
    if (!name.starts_with(prefix)) continue;
    if (const Key<Interface>* key = find_key(interface_keys(), name.substr(prefix.size())))
      return InterfaceKey{body, key};
  }
  return std::nullopt;
}

/// The interface of a body; a bonded one where the scene says nothing of it.
Interface& interface_of(Scene& scene, const std::string& body) {
  for (Interface& faces : scene.interfaces)
    if (faces.body == body) return faces;
  return scene.interfaces.emplace_back(Interface{.body = body});
}

std::vector<std::string> names_of_keys(const Scene& scene) {
  std::vector<std::string> names;
  for (const Key<Scene>& key : scene_keys()) names.push_back(key.name);
  for (const Body& body : scene.bodies) {
    names.push_back(fmt::format("body.{}.x", body.name));
    names.push_back(fmt::format("body.{}.r", body.name));
  }
  for (const std::string& body : bodies_at_the_charge(scene))
    for (const Key<Interface>& key : interface_keys())
      names.push_back(fmt::format("interface.{}.{}", body, key.name));
  return names;
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
  if (const Key<Scene>* key = find_key(scene_keys(), name)) return KeyDescription(*key);
  const auto of_body = find_body_key(file.scene, name);
  const auto of_faces = find_interface_key(file.scene, name);
  if (!of_body && !of_faces) return unknown_key(place, name, names_of_keys(file.scene));
  KeyDescription description = of_body ? KeyDescription(*of_body->key) : KeyDescription(*of_faces->key);
  description.name = name;
  return description;
}

Value value_in(const SceneFile& file, const std::string& name) {
  if (const Key<Scene>* key = find_key(scene_keys(), name)) return key->get(file.scene);
  const auto faces = find_interface_key(file.scene, name);
  assert(faces);
  Scene scene = file.scene;
  return faces->key->get(interface_of(scene, faces->body));
}

Expected<SceneFile> with_keys(const SceneFile& file, const std::vector<KeyChange>& changes) {
  SceneFile changed = file;
  bool other_curve = false;
  for (const auto& [name, value, place] : changes) {
    const auto description = describe_key(file, name, place);
    if (!description) return description.error();
    if (const auto found = find_body_key(file.scene, name)) {
      found->key->set(changed.scene.bodies[found->body], value);
      changed.places[name] = place;
    } else if (const auto faces = find_interface_key(file.scene, name)) {
      Interface& owner = interface_of(changed.scene, faces->body);
      const bool slid = owner.condition == Condition::sliding;
      faces->key->set(owner, value);
      // The friction of faces that slid is none of theirs once they are bonded.
      if (slid && owner.condition == Condition::bonded) owner.friction.reset();
      changed.places[name] = place;
    } else {
      for (const std::string& overridden : description->overrides) changed.given.erase(overridden);
      changed.given[name] = {place, value};
    }
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
