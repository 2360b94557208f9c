
#include "launchsafe/scene/read_scene.hpp"

#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

const std::vector<std::string> read_apart{"body", "observation_point", "interface", "material", "constants"};

/// Reads [[name]] tables into `owners`; the places become "name.<name of the owner>.<key>".
template <class Owner>
void read_named(const toml::table& root, const std::string& name, const std::vector<Key<Owner>>& keys,
                const std::string& file, std::vector<Owner>& owners, std::map<std::string, Place>& places) {
  const std::string allowed = fmt::format("tables, each written [[{}]]", name);
  for (auto& [owner, own_places] : read_tables(root, name, keys, file, allowed).or_throw()) {
    // Of two with one name the second one's place stands: that is the one to complain about.
    for (auto& [key, place] : own_places)
      places.insert_or_assign(fmt::format("{}.{}.{}", name, owner.name, key), std::move(place));
    owners.push_back(std::move(owner));
  }
}

void read_curve_file(SceneFile& file) {
  Load& load = file.scene.load;
  if (load.curve_file.empty()) return;
  const auto path =
      named_file(file.folder, load.curve_file, place_of_key(file, "load.curve"), "load.curve", "a CSV file");
  PressureCurve curve = read_pressure_curve(path).or_throw();
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
    file.scene.load.in_barrel = std::move(fresh.load.in_barrel);
  } else {
    read_curve_file(file);
  }
  settle_load(file.scene);
  if (!is_valid) check_curve(file);
  build_curve(file.scene.load);
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

/// Keys of an interface, of which the condition takes back the friction of faces that it makes bonded for
/// good.
std::vector<Key<Interface>> changing_interface_keys() {
  std::vector<Key<Interface>> keys = interface_keys();
  keys::then([](Interface& faces) {
    if (!can_slide(faces)) faces.friction.reset();
  })(*std::ranges::find(keys, "condition", &KeyDescription::name));
  return keys;
}

/// Keys of the scene's bodies, "body.<name>.x", ".r" and ".material", of the interfaces of all bodies that
/// touch the charge, "interface.<name>.<key>".
std::vector<Key<SceneFile>> keys_of_tables(const SceneFile& file) {
  const Scene& scene = file.scene;
  std::vector<Key<SceneFile>> all;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string prefix = "body." + scene.bodies[i].name + ".";
    for (Key<SceneFile>& key : keys::keys_of_part<SceneFile>(
             prefix, [i](auto& owner) -> auto& { return owner.scene.bodies[i]; }, body_keys()))
      if (key.kind == KeyKind::range) all.push_back(std::move(key));
    Key<SceneFile> material = text_key<SceneFile>(
        prefix + "material", Standing::input, find_key(body_keys(), "material")->sentence,
        "comp-b", [i](auto& owner) -> auto& { return owner.body_materials[i]; });
    all.push_back(std::move(material));
  }
  for (const std::string& body : bodies_at_the_charge(scene))
    all = keys::joined({all, keys::keys_of_part<SceneFile>(
                                 "interface." + body + ".",
                                 [body](auto& owner) -> auto& { return interface_of(owner.scene, body); },
                                 changing_interface_keys())});
  return all;
}

/// The keys of the scene itself, on the scene of a file.
const std::vector<Key<SceneFile>>& keys_of_scene() {
  static const std::vector<Key<SceneFile>> keys = keys::keys_of_part("", &SceneFile::scene, scene_keys());
  return keys;
}

Key<SceneFile> key_named(const SceneFile& file, const std::string& name, const Place& place) {
  if (const Key<SceneFile>* key = find_key(keys_of_scene(), name)) return *key;
  const std::vector<Key<SceneFile>> of_tables = keys_of_tables(file);
  if (const Key<SceneFile>* key = find_key(of_tables, name)) return *key;
  throw unknown_key(place, name, names_of(keys::joined({keys_of_scene(), of_tables})));
}

std::string text_as_toml(const std::string& text) { return exact_toml({.kind = KeyKind::text}, text); }

/// All keys that are written, one a line.
template <class Owner>
std::string lines_of(const std::string& prefix, const std::vector<Key<Owner>>& keys, const Owner& owner) {
  std::string text;
  for (const Key<Owner>& key : keys)
    if (!key.is_written || key.is_written(owner))
      text += fmt::format("{}{} = {}\n", prefix, key.name, exact_toml(key, key.get(owner)));
  return text;
}

/// As "interface.'NAME'.KEY = VALUE", one a line, in the order of names, in which files are read: the order
/// in which a program made them says nothing.
std::string interfaces_as_toml(std::vector<Interface> interfaces) {
  std::ranges::stable_sort(interfaces, {}, &Interface::body);
  std::string text;
  for (const Interface& faces : interfaces) {
    const std::string prefix = fmt::format("interface.{}.", text_as_toml(faces.body));
    text += lines_of(prefix, interface_keys(), faces);
    // Only programs make these; files cannot say them, but texts of different scenes differ.
    if (!faces.against.empty()) text += fmt::format("{}against = {}\n", prefix, text_as_toml(faces.against));
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

/// Materials under other names than their law's.
std::string own_materials(const Scene& scene) {
  std::string text;
  for (const Material& material : scene.materials) {
    const auto add = [&]<class Law>(const Law& law) {
      if (material.name == Law::name) return;
      const std::string prefix = fmt::format("material.\"{}\".", material.name);
      text += fmt::format("{}law = '{}'\n", prefix, Law::name);
      if (!material.title.empty())
        text += fmt::format("{}title = {}\n", prefix, text_as_toml(material.title));
      for (const Key<Law>& key : Law::parameters()) {
        const std::string name = key_in_material(Law::name, key.name);
        text += fmt::format("{}{} = {}\n", prefix, name, exact_toml(key, key.get(law)));
      }
    };
    std::visit(add, material.law);
  }
  return text;
}

}  // namespace

Place place_of_key(const SceneFile& file, const std::string& key) {
  if (const Given* given = find_in(file.given, key)) return given->place;
  const Place* place = find_in(file.places, key);
  return place != nullptr ? *place : Place{file.file};
}

namespace {

/// The constants that a scene file names; the default ones where it names none.
std::shared_ptr<const Constants> read_constants_of(const toml::table& table, const SceneFile& file) {
  constexpr const char* key = "constants";
  const toml::node* node = table.get(key);
  if (node == nullptr) return shipped_constants().front();
  const Place place = place_of(*node, file.file);
  const auto name = node->value<std::string>();
  if (!node->is_string())
    throw error_at(place, key, found_text(*node), "the name or path of a constants file, in quotation marks");
  return find_constants(*name, file.folder, place, key);
}

}  // namespace

Expected<SceneFile> parse_scene(std::string_view text, const std::filesystem::path& path) {
  return caught([&] {
    const toml::table table = parse_toml(text, path.string()).or_throw();
    SceneFile file;
    file.file = path.string();
    file.folder = path.parent_path();
    check_content(table, file.file, InputContent::scene);
    Scene& scene = file.scene;
    // Faults of the keys first, then of the tables; within each by line.
    ReadValues read = read_described(table, descriptions_of(scene_keys()), read_apart, file.file).or_throw();
    for (auto& [index, value] : read.values) {
      const std::string& name = scene_keys()[index].name;
      file.given[name] = {read.places[name], std::move(value)};
    }
    read_named(table, "body", body_keys(), file.file, scene.bodies, file.places);
    read_named(table, "observation_point", observation_point_keys(), file.file,
               scene.output.observation_points, file.places);
    file.constants = read_constants_of(table, file);
    file.materials = read_materials(table, file.file);
    for (const Body& body : scene.bodies) file.body_materials.push_back(body.material);
    read_interfaces(table, file.file, scene, file.places);
    rebuild(file, false);
    check_expected_velocity(file);
    return file;
  });
}

Expected<SceneFile> read_scene(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  return text ? parse_scene(*text, file) : text.error();
}

Expected<KeyDescription> describe_key(const SceneFile& file, const std::string& name, const Place& place) {
  return caught([&] { return KeyDescription(key_named(file, name, place)); });
}

Value value_in(const SceneFile& file, const std::string& name) { return key_named(file, name, {}).get(file); }

Expected<SceneFile> with_keys(const SceneFile& file, const std::vector<KeyChange>& changes, bool is_valid) {
  return caught([&, changed = file]() mutable {
    bool other_curve = false;
    for (const KeyChange& change : changes)
      if (const auto* key = find_key(scene_keys(), change.name))
        for (const std::string& overridden : key->overrides) changed.given.erase(overridden);
    for (const auto& [name, value, place] : changes) {
      const Key<SceneFile> key = key_named(changed, name, place);
      if (find_key(scene_keys(), name) == nullptr) {
        key.set(changed, value);
        changed.places[name] = place;
        continue;
      }
      changed.given[name] = {place, value};
      other_curve = other_curve || name == "load.curve";
    }
    rebuild(changed, !other_curve, is_valid);
    return std::move(changed);
  });
}

Expected<SceneFile> with_constants(const SceneFile& file, std::shared_ptr<const Constants> constants) {
  return caught([&, changed = file]() mutable {
    changed.constants = std::move(constants);
    rebuild(changed, true);
    return std::move(changed);
  });
}

std::vector<ListedKey> list_keys(const SceneFile& file) {
  std::vector<ListedKey> listed;
  for (const Key<Scene>& key : scene_keys()) {
    const Given* given = find_in(file.given, key.name);
    if (!given && key.is_written && !key.is_written(file.scene)) continue;
    listed.push_back({key.name, format_value(key, key.get(file.scene)), key.sentence});
  }
  return listed;
}

std::string to_toml(const Scene& scene) {
  return fmt::format("constants = '{}'\n", no_constants) + lines_of("", scene_keys(), scene) +
         own_materials(scene) + interfaces_as_toml(scene.interfaces) +
         inline_tables("body", body_keys(), scene.bodies) +
         inline_tables("observation_point", observation_point_keys(), scene.output.observation_points);
}

}  // namespace launchsafe::scene
