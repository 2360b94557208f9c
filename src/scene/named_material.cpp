// Materials as tables of numbers: a file, a table [material.NAME] of a scene, or one that ships; and a scene
// whose bodies are of these.
#include "scene_file.hpp"

#include <cstdio>
#include <cstdlib>

namespace launchsafe::scene {
namespace {

/// Under their names in a scene.
std::vector<KeyDescription> keys_of_law(const std::string& law) {
  std::vector<KeyDescription> keys;
  materials::for_each_law([&]<class Law>(const Law&) {
    if (law == Law::name) std::ranges::copy(Law::parameters(), std::back_inserter(keys));
  });
  return keys;
}

std::string read_law(const toml::table& table, const Place& place, const std::string& file) {
  const KeyDescription& key = *find_key(material_keys(), "law");
  const toml::node* node = table.get("law");
  if (node == nullptr) throw error_at(place, "law", "nothing; the key is missing", allowed_text(key));
  return std::get<std::string>(read_value(*node, key, file).or_throw());
}

/// Whether a key of the law that is not given is settled by one that is, as a constant of one equation of
/// state is by those of another.
bool is_settled(const NamedMaterial& material, const KeyDescription& key,
                const std::vector<KeyDescription>& keys) {
  return std::ranges::any_of(keys, [&](const KeyDescription& other) {
    return material.values.contains(other.name) &&
           (contains(other.overrides, key.name) || contains(key.overrides, other.name));
  });
}

void check_complete(const NamedMaterial& material) {
  const std::vector<KeyDescription> keys = keys_of_law(material.law);
  for (const KeyDescription& key : keys) {
    if (material.values.contains(key.name) || is_settled(material, key, keys) || !key.usual.empty()) continue;
    throw error_at(material.place, key_in_material(material.law, key.name), "nothing; the key is missing",
                   allowed_text(key));
  }
}

/// A table with all numbers of a material.
NamedMaterial read_material(const std::string& name, const toml::table& table, const std::string& file) {
  NamedMaterial material;
  material.name = name;
  material.place = place_of(table, file);
  const std::string law = read_law(table, material.place, file);
  std::vector<KeyDescription> law_keys = keys_of_law(law);
  std::map<std::string, std::string> scene_keys;  // by their names here
  std::vector<const KeyDescription*> described = descriptions_of(material_keys());
  const std::size_t own = described.size();
  for (KeyDescription& key : law_keys) {
    const std::string scene_key = std::exchange(key.name, key_in_material(law, key.name));
    scene_keys[key.name] = scene_key;
    described.push_back(&key);
  }
  const ReadValues read = read_described(table, described, {}, file).or_throw();
  for (const auto& [index, value] : read.values) {
    const std::string& key = described[index]->name;
    if (index < own)
      material_keys()[index].set(material, value);
    else
      material.values[scene_keys.at(key)] = {read.places.at(key), value, true};
  }
  check_complete(material);
  return material;
}

/// The material of a file that a body names by its path; none where the name is no path.
const NamedMaterial* read_material_file(SceneFile& file, const std::string& body, const std::string& name) {
  if (!name.ends_with(".toml")) return nullptr;
  const std::string key = "body." + body + ".material";
  const std::filesystem::path path =
      named_file(file.folder, name, place_of_key(file, key), key, "a TOML file of a material");
  const toml::table table = parse_toml(read_text_file(path).or_throw(), path.string()).or_throw();
  return &file.materials.emplace_back(read_material(name, table, path.string()));
}

/// The material of a name that a scene file knows: its own, or a shipped one.
const NamedMaterial* find_named_material(const SceneFile& file, const std::string& name) {
  for (const auto* list : {&file.materials, &shipped_materials()})
    if (const NamedMaterial* found = find_named(*list, name)) return found;
  return nullptr;
}

/// Names of the materials of each law that bodies are of, in the order of the bodies.
using NamesByLaw = std::map<std::string, std::vector<std::string>>;

InputError unknown_material(const SceneFile& file, const std::string& body, const std::string& name) {
  std::vector<std::string> names = names_of(usual_materials());
  for (const auto* list : {&file.materials, &shipped_materials()})
    for (const NamedMaterial& each : *list) names.push_back(each.name);
  return fault_at(file, "body." + body + ".material",
                  fmt::format("\"{}\", a material that is nowhere described", name),
                  quoted_list(names) + "; or the path of a material's file, which ends with .toml",
                  in_quotes(nearest_of(name, names)));
}

NamesByLaw names_by_law(SceneFile& file, const Scene& scene) {
  NamesByLaw by_law;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string &name = file.body_materials[i], &body = scene.bodies[i].name;
    const NamedMaterial* named = find_named_material(file, name);
    if (named == nullptr) named = read_material_file(file, body, name);
    if (named == nullptr && find_named(usual_materials(), name) == nullptr)
      throw unknown_material(file, body, name);
    std::vector<std::string>& names = by_law[named ? named->law : name];
    if (!contains(names, name)) names.push_back(name);
  }
  return by_law;
}

/// Whether the scene itself gives the key, or one that overrides it.
bool scene_gives(const SceneFile& file, const std::string& name) {
  return std::ranges::any_of(file.given, [&](const auto& each) {
    return !each.second.of_material &&
           (each.first == name || contains(find_key(scene_keys(), each.first)->overrides, name));
  });
}

/// A law with the numbers of a material.
template <class Law>
Law law_with(const NamedMaterial& material) {
  Law law;
  for (const Key<Law>& key : Law::parameters())
    if (const Given* given = find_in(material.values, key.name)) key.set(law, given->value);
  return law;
}

/// Throws that of a key of [kinetics] in the scene's own file by which the charge would not react as its
/// material does.
void check_kinetics_of(const NamedMaterial& material, const SceneFile& file) {
  static const std::vector<Key<Charge>> keys = Charge::parameters();
  const Charge own = law_with<Charge>(material);
  Charge stated = own;
  for (const Key<Charge>& key : keys) {
    const Given* given = find_in(file.given, key.name);
    if (given != nullptr && key.name.starts_with("kinetics.") && given->place.file == file.file)
      key.set(stated, given->value);
  }
  for (const Key<Charge>& key : keys) {
    const Given* of_its_own = find_in(material.values, key.name);
    if (!key.name.starts_with("kinetics.") || of_its_own == nullptr || key.get(stated) == key.get(own))
      continue;
    const Place& of_material = of_its_own->place;
    throw error_at(
        find_in(file.given, key.name)->place, key.name,
        fmt::format("{} = {} beside {} of the material \"{}\"", key.name, format_value(key, key.get(stated)),
                    format_value(key, key.get(own)), material.name),
        fmt::format("the kinetics of the charge's material alone, {}:{}", of_material.file,
                    of_material.line));
  }
}

/// The named material as the scene's material of its law. A number that is the program's own is no given one:
/// what rests on defaults, such as the constants of a calibration, stays as it is.
void use_as_law(const NamedMaterial& material, SceneFile& file) {
  if (material.law == Charge::name) check_kinetics_of(material, file);
  materials::for_each_law([&]<class Law>(const Law& usual) {
    if (material.law != Law::name) return;
    static const std::vector<Key<Law>> keys = Law::parameters();
    for (const Key<Law>& key : keys) {
      const Given* given = find_in(material.values, key.name);
      if (given == nullptr || scene_gives(file, key.name)) continue;
      if (given->value != key.get(usual) || (key.is_written && !key.is_written(usual)))
        file.given[key.name] = *given;
    }
  });
  const std::string title = material.law + ".title";
  if (!material.title.empty() && !scene_gives(file, title))
    file.given[title] = {material.place, Value(material.title), true};
}

/// The named material beside another one of its law.
void add_beside(const NamedMaterial& material, Scene& scene) {
  materials::for_each_law([&]<class Law>(const Law&) {
    if (material.law == Law::name)
      scene.materials.push_back({material.name, law_with<Law>(material), material.title});
  });
}

InputError two_explosives(const SceneFile& file, const Scene& scene, const std::vector<std::string>& names) {
  const auto second = std::ranges::find(file.body_materials, names[1]) - file.body_materials.begin();
  return fault_at(file, "body." + scene.bodies[static_cast<std::size_t>(second)].name + ".material",
                  fmt::format("\"{}\" beside \"{}\", two explosives", names[1], names[0]),
                  "one explosive in a scene, whose skin is followed");
}

/// Keys of a law of whose materials none has the law's name.
void check_unambiguous(const SceneFile& file, const std::string& law, const std::vector<std::string>& names) {
  for (const auto& [key, given] : file.given)
    if (!given.of_material && key.starts_with(law + "."))
      throw error_at(given.place, key,
                     fmt::format("a key of [{}], where bodies are of {}", law, quoted_list(names)),
                     fmt::format("numbers in the file of each, or a body of material \"{}\"", law));
}

}  // namespace

const std::vector<Key<NamedMaterial>>& material_keys() {
  static const std::vector<Key<NamedMaterial>> keys = [] {
    Key<NamedMaterial> law = text_key("law", Standing::input, "Law whose numbers the table gives.", "charge",
                                      &NamedMaterial::law) |
                             required();
    law.kind = KeyKind::word;
    law.words = names_of(usual_materials());
    return std::vector<Key<NamedMaterial>>{
        law, text_key("title", Standing::input, "What the material is, for reports.", "PBX 9501",
                      &NamedMaterial::title)};
  }();
  return keys;
}

std::string key_in_material(std::string_view law, std::string_view scene_key) {
  const bool own =
      scene_key.starts_with(law) && scene_key.size() > law.size() && scene_key[law.size()] == '.';
  return std::string(own ? scene_key.substr(law.size() + 1) : scene_key);
}

const std::vector<NamedMaterial>& shipped_materials() {
  static const std::vector<NamedMaterial> all = []() noexcept {  // a fault is one of the program itself
    std::vector<NamedMaterial> read;
    for (const auto& [file, text] : built_in_materials()) {
      const std::string place = "the shipped " + file;
      read.push_back(
          read_material(std::filesystem::path(file).stem(), parse_toml(text, place).or_throw(), place));
    }
    return read;
  }();
  return all;
}

std::vector<NamedMaterial> read_materials(const toml::table& root, const std::string& file) {
  std::vector<NamedMaterial> materials;
  visit_tables(
      root, "material", "that bodies refer to", file, [&](const std::string& name, const toml::table& table) {
        if (find_named(usual_materials(), name) != nullptr)
          throw error_at(place_of(table, file), "material", fmt::format("a material called \"{}\"", name),
                         "a name that no law has", fmt::format("[{}]", name));
        materials.push_back(within("material." + name, [&] { return read_material(name, table, file); }));
      });
  return materials;
}

std::string kinetics_origin(const SceneFile& file) {
  const auto at = [](const std::string& what, const Place& place) {
    const std::string name = std::filesystem::path(place.file).filename().string();
    return fmt::format("{} ({}:{})", what, name, place.line);
  };
  std::string origin = "the default";
  for (const std::string& name : file.body_materials) {
    const NamedMaterial* material = find_named_material(file, name);
    if (material != nullptr && material->law == Charge::name)
      origin = at(fmt::format("material \"{}\"", name), material->place);
  }
  for (const char* key :
       {"kinetics.activation_temperature", "kinetics.frequency", "kinetics.heat_of_reaction"})
    if (const Given* number = find_in(file.given, key); number != nullptr && !number->of_material)
      origin += "; " + at(key, number->place);
  return origin;
}

void use_materials(SceneFile& file, Scene& scene) {
  std::erase_if(file.given, [](const auto& each) { return each.second.of_material; });
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) scene.bodies[i].material = file.body_materials[i];
  for (const auto& [law, names] : names_by_law(file, scene)) {
    const bool has_own = contains(names, law);
    if (names.size() > 1 && is_explosive(find_material(scene, law)->law))
      throw two_explosives(file, scene, names);
    if (names.size() > 1 && !has_own) check_unambiguous(file, law, names);
    const std::string& first = has_own ? law : names.front();
    for (Body& body : scene.bodies)
      if (body.material == first) body.material = law;
    for (const std::string& name : names) {
      const NamedMaterial* named = find_named_material(file, name);
      if (named == nullptr) continue;
      if (name == first)
        use_as_law(*named, file);
      else
        add_beside(*named, scene);
    }
  }
}

}  // namespace launchsafe::scene
