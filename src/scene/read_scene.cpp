#include "launchsafe/scene/read_scene.hpp"

#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// Reads [[name]] tables; the places become "name.<name of the owner>.<key>".
template <class Owner>
std::vector<Owner> read_named(const toml::table& root, const std::string& name,
                              const std::vector<Key<Owner>>& keys, SceneFile& file) {
  std::vector<Owner> owners;
  for (auto& [owner, places] :
       read_tables(root, name, keys, file.file, fmt::format("tables, each written [[{}]]", name))) {
    // Of two with one name the second one's place stands: that is the one to complain about.
    for (const auto& [key, place] : places)
      file.places[fmt::format("{}.{}.{}", name, owner.name, key)] = place;
    owners.push_back(std::move(owner));
  }
  return owners;
}

/// Reads all [interface.NAME], in the order of their names.
void read_interfaces(const toml::table& root, SceneFile& file) {
  const toml::node* node = root.get("interface");
  if (node == nullptr) return;
  const auto table_in = [&](const toml::node& found, const std::string& key) -> const toml::table& {
    if (const toml::table* table = found.as_table()) return *table;
    throw error_at(place_of(found, file.file), key, found_text(found),
                   "tables, each written [interface.NAME] with the name of the body that touches the charge");
  };
  for (const auto& [body, inner] : table_in(*node, "interface")) {
    const std::string name = "interface." + std::string(body.str());
    const toml::table& table = table_in(inner, name);
    file.places[name] = place_of(table, file.file);
    Interface& faces = file.scene.interfaces.emplace_back(Interface{.body = std::string(body.str())});
    within(name, [&] {
      for (const auto& [key, place] : read_table(table, interface_keys(), {}, file.file, faces))
        file.places[name + "." + key] = place;
    });
  }
}

/// The constants that a scene file names; the default ones where it names none.
std::shared_ptr<const Constants> read_constants_of(const toml::table& table, const SceneFile& file) {
  const toml::node* node = table.get("constants");
  if (node == nullptr) return shipped_constants().front();
  const Place place = place_of(*node, file.file);
  if (const auto* name = node->as_string())
    return find_constants(name->get(), file.folder, place, "constants");
  throw error_at(place, "constants", found_text(*node),
                 "the name or path of a constants file, in quotation marks");
}

void read_curve_file(SceneFile& file) {
  Load& load = file.scene.load;
  if (load.curve_file.empty()) return;
  const auto path =
      named_file(file.folder, load.curve_file, place_of_key(file, "load.curve"), "load.curve", "a CSV file");
  PressureCurve curve = parse_pressure_curve(read_text_file(path, largest_curve), path.string());
  load.curve_time = std::move(curve.time);
  load.curve_pressure = std::move(curve.pressure);
}

/// The scene from its bodies, its points and the given keys, applied in the order of their declaration. The
/// file of a measured curve is read unless the scene has it already. What is known to be valid is not held
/// against all that a scene must be.
void rebuild(SceneFile& file, bool has_curve, bool is_valid = false) {
  Scene fresh;
  fresh.bodies = std::move(file.scene.bodies);
  fresh.output.observation_points = std::move(file.scene.output.observation_points);
  fresh.interfaces = std::move(file.scene.interfaces);
  use_materials(file, fresh);
  for (const Key<Scene>& key : scene_keys())
    if (const Given* given = find_in(file.given, key.name))
      key.set(fresh, given->value);
    else if (const Value* constant = constant_of(file, key.name))
      key.set(fresh, *constant);
  hold_by_constants(file, fresh);
  std::swap(file.scene, fresh);
  if (has_curve && !file.scene.load.curve_file.empty()) {
    file.scene.load.curve_time = std::move(fresh.load.curve_time);
    file.scene.load.curve_pressure = std::move(fresh.load.curve_pressure);
  } else {
    read_curve_file(file);
  }
  if (!is_valid) check_curve(file);
  find_exit(file.scene);
  if (!file.given.contains("numerics.selective_inertia"))
    file.scene.numerics.selective_inertia = usual_selective_inertia(file.scene);
  if (!is_valid) validate(file);
}

/// The interface of a body, to be changed; a bonded one where the scene says nothing of it.
Interface& interface_of(Scene& scene, const std::string& body) {
  const auto faces = std::ranges::find(scene.interfaces, body, &Interface::body);
  if (faces == scene.interfaces.end()) return scene.interfaces.emplace_back(Interface{.body = body});
  faces->from_constants = false;
  return *faces;
}
const Interface& interface_of(const Scene& scene, const std::string& body) {
  static const Interface bonded{};
  const auto faces = std::ranges::find(scene.interfaces, body, &Interface::body);
  return faces != scene.interfaces.end() ? *faces : bonded;
}

/// Keys of the scene's bodies, "body.<name>.x", ".r" and ".material", and of the interfaces of all bodies
/// that touch the charge, "interface.<name>.<key>".
std::vector<Key<SceneFile>> keys_of_tables(const SceneFile& file) {
  const Scene& scene = file.scene;
  std::vector<Key<SceneFile>> all;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string prefix = "body." + scene.bodies[i].name + ".";
    for (Key<SceneFile>& key : keys::keys_of_part<SceneFile>(
             prefix, [i](auto& owner) -> auto& { return owner.scene.bodies[i]; }, body_keys()))
      if (key.kind == KeyKind::range) all.push_back(std::move(key));
    all.push_back(text_key<SceneFile>(
        prefix + "material", Standing::input, find_key(body_keys(), "material")->sentence,
        "comp-b", [i](auto& owner) -> auto& { return owner.body_materials[i]; }));
  }
  std::vector<Key<Interface>> of_faces = interface_keys();
  // The condition takes back the friction of faces that it makes bonded for good.
  keys::then([](Interface& faces) {
    if (!can_slide(faces)) faces.friction.reset();
  })(*std::ranges::find(of_faces, "condition", &KeyDescription::name));
  for (const std::string& body : bodies_at_the_charge(scene))
    all = keys::joined(
        {all, keys::keys_of_part<SceneFile>(
                  "interface." + body + ".",
                  [body](auto& owner) -> auto& { return interface_of(owner.scene, body); }, of_faces)});
  return all;
}

Key<SceneFile> key_named(const SceneFile& file, const std::string& name, const Place& place) {
  static const std::vector<Key<SceneFile>> of_scene = keys::keys_of_part("", &SceneFile::scene, scene_keys());
  if (const Key<SceneFile>* key = find_key(of_scene, name)) return *key;
  const std::vector<Key<SceneFile>> of_tables = keys_of_tables(file);
  if (const Key<SceneFile>* key = find_key(of_tables, name)) return *key;
  throw unknown_key(place, name, names_of(keys::joined({of_scene, of_tables})));
}

/// As "interface.'NAME'.KEY = VALUE", one a line, in the order of names, in which files are read: the order
/// in which a program made them says nothing.
std::string interfaces_as_toml(std::vector<Interface> interfaces) {
  const auto quoted = [](const std::string& text) { return exact_toml({.kind = KeyKind::text}, text); };
  std::ranges::stable_sort(interfaces, {}, &Interface::body);
  std::string text;
  for (const Interface& faces : interfaces) {
    const std::string prefix = fmt::format("interface.{}.", quoted(faces.body));
    text += lines_of(prefix, interface_keys(), faces);
    // Only programs make these; files cannot say them, but texts of different scenes differ.
    if (!faces.against.empty()) text += fmt::format("{}against = {}\n", prefix, quoted(faces.against));
  }
  return text;
}

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

}  // namespace

Place place_of_key(const SceneFile& file, const std::string& key) {
  if (const Given* given = find_in(file.given, key)) return given->place;
  const Place* place = find_in(file.places, key);
  return place != nullptr ? *place : Place{file.file};
}

SceneFile parse_scene(std::string_view text, const std::filesystem::path& path) {
  SceneFile file;
  file.file = path.string();
  file.folder = path.parent_path();
  const toml::table table = parse_toml(text, file.file);
  check_content(table, file.file, InputContent::scene);
  // Faults of the keys first, then of the tables; within each by line.
  file.given = read_described(table, descriptions_of(scene_keys()),
                              {"body", "observation_point", "interface", "constants"}, file.file);
  file.scene.bodies = read_named(table, "body", body_keys(), file);
  file.scene.output.observation_points =
      read_named(table, "observation_point", observation_point_keys(), file);
  file.constants = read_constants_of(table, file);
  for (const Body& body : file.scene.bodies) file.body_materials.push_back(body.material);
  read_interfaces(table, file);
  rebuild(file, false);
  check_expected_velocity(file);
  return file;
}

SceneFile read_scene(const std::filesystem::path& file) { return parse_scene(read_text_file(file), file); }

KeyDescription describe_key(const SceneFile& file, const std::string& name, const Place& place) {
  return key_named(file, name, place);
}

Value value_in(const SceneFile& file, const std::string& name) { return key_named(file, name, {}).get(file); }

SceneFile with_keys(const SceneFile& file, const std::vector<KeyChange>& changes, bool is_valid) {
  SceneFile changed = file;
  bool other_curve = false;
  for (const KeyChange& change : changes)
    if (const auto* key = find_key(scene_keys(), change.name))
      for (const std::string& overridden : key->overrides) changed.given.erase(overridden);
  for (const auto& [name, value, place] : changes) {
    if (find_key(scene_keys(), name) != nullptr) {
      changed.given[name] = {place, value};
      other_curve = other_curve || name == "load.curve";
    } else {
      key_named(changed, name, place).set(changed, value);
      changed.places[name] = place;
    }
  }
  rebuild(changed, !other_curve, is_valid);
  return changed;
}

SceneFile with_constants(const SceneFile& file, std::shared_ptr<const Constants> constants) {
  SceneFile changed = file;
  changed.constants = std::move(constants);
  rebuild(changed, true);
  return changed;
}

std::vector<ListedKey> list_keys(const SceneFile& file) {
  std::vector<ListedKey> listed;
  for (const Key<Scene>& key : scene_keys())
    if (file.given.contains(key.name) || !key.is_written || key.is_written(file.scene))
      listed.push_back({key.name, format_value(key, key.get(file.scene)), key.sentence});
  return listed;
}

std::string to_toml(const Scene& scene) {
  return fmt::format("constants = '{}'\n", no_constants) + lines_of("", scene_keys(), scene) +
         interfaces_as_toml(scene.interfaces) + inline_tables("body", body_keys(), scene.bodies) +
         inline_tables("observation_point", observation_point_keys(), scene.output.observation_points);
}

}  // namespace launchsafe::scene
