// The tables [material.NAME] of a file, and a scene whose bodies are of these.
#include "scene_file.hpp"

#include <set>

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

/// One table [material.NAME], without what it takes of another material.
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
  const ReadValues read = read_described(table, described, {"source"}, file).or_throw();
  std::vector<std::string> given;
  for (const auto& [index, value] : read.values) {
    const std::string& key = described[index]->name;
    if (index < own)
      material_keys()[index].set(material, value);
    else
      material.values[scene_keys.at(given.emplace_back(key))] = {read.places.at(key), value, true};
  }
  material.sources = read_sources(table, given, file);
  for (Source& source : material.sources)
    for (std::string& key : source.keys) key = scene_keys.at(key);
  return material;
}

void check_name(const toml::node& node, const std::string& name, const std::string& file,
                const std::vector<NamedMaterial>& known) {
  const bool is_law = find_named(usual_materials(), name) != nullptr;
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  const bool plain = !name.empty() && name.find_first_not_of(letters) == std::string::npos;
  if (plain && !is_law && find_named(known, name) == nullptr) return;
  throw error_at(place_of(node, file), "material", fmt::format("a material called \"{}\"", name),
                 "a name of letters, digits, - and _ that no law and no other material has",
                 is_law ? fmt::format("[{}]", name) : std::string{});
}

/// Whether a key of the law that is not given is settled by one that is, as kinetics.set is by its numbers.
bool is_settled(const NamedMaterial& material, const KeyDescription& key,
                const std::vector<KeyDescription>& keys) {
  return std::ranges::any_of(keys, [&](const KeyDescription& other) {
    return material.values.contains(other.name) &&
           (contains(other.overrides, key.name) || contains(key.overrides, other.name));
  });
}

/// Takes what a material does not give from the one that it is like, and says so of each value.
void take_over(NamedMaterial& material, const NamedMaterial& from) {
  const std::vector<KeyDescription> keys = keys_of_law(material.law);
  const NamedMaterial own = material;
  Source taken{{}, Standing::assumed, "as of " + from.name};
  for (const KeyDescription& key : keys) {
    const auto value = from.values.find(key.name);
    if (value == from.values.end() || own.values.contains(key.name) || is_settled(own, key, keys)) continue;
    material.values.insert(*value);
    taken.keys.push_back(key.name);
  }
  if (!taken.keys.empty()) material.sources.push_back(std::move(taken));
}

void check_complete(const NamedMaterial& material) {
  const std::vector<KeyDescription> keys = keys_of_law(material.law);
  for (const KeyDescription& key : keys) {
    if (material.values.contains(key.name) || is_settled(material, key, keys) || !key.usual.empty()) continue;
    throw error_at(
        material.place, fmt::format("material.{}.{}", material.name, key_in_material(material.law, key.name)),
        "nothing; the key is missing",
        fmt::format("{}; or like = \"NAME\", a material whose value stands for it", allowed_text(key)));
  }
}

/// Completes a material after the one that it is like.
void complete(std::vector<NamedMaterial>& materials, std::size_t index, std::vector<bool>& done,
              const std::vector<NamedMaterial>& known, std::size_t depth = 0) {
  NamedMaterial& material = materials[index];
  if (done[index]) return;
  if (!material.like.empty()) {
    const auto fault = [&](std::string found, std::string allowed) {
      return error_at(material.place, "material." + material.name + ".like", found, allowed);
    };
    if (depth > materials.size())
      throw fault(fmt::format("\"{}\", which is like this material", material.like),
                  "a material with numbers of its own");
    const NamedMaterial* other = find_named(known, material.like);
    const NamedMaterial* own = find_named(materials, material.like);
    if (other == nullptr && own != nullptr) {
      complete(materials, static_cast<std::size_t>(own - materials.data()), done, known, depth + 1);
      other = own;
    }
    if (other == nullptr || other->law != material.law)
      throw fault(fmt::format("\"{}\"", material.like),
                  fmt::format("the name of a material of law \"{}\"", material.law));
    take_over(material, *other);
  }
  done[index] = true;
  check_complete(material);
}

/// Names of the materials of each law that bodies are of, in the order of the bodies.
using NamesByLaw = std::map<std::string, std::vector<std::string>>;

InputError unknown_material(const SceneFile& file, const std::string& body, const std::string& name) {
  std::vector<std::string> names = names_of(usual_materials());
  for (const auto* list : {&file.materials, &shipped_materials()})
    for (const NamedMaterial& each : *list) names.push_back(each.name);
  return fault_at(file, "body." + body + ".material",
                  fmt::format("\"{}\", a material that is nowhere described", name),
                  quoted_list(names) + "; or one that a table [material.NAME] describes",
                  in_quotes(nearest_of(name, names)));
}

NamesByLaw names_by_law(const SceneFile& file, const Scene& scene) {
  NamesByLaw by_law;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string& name = file.body_materials[i];
    const NamedMaterial* named = find_named_material(file, name);
    if (named == nullptr && find_named(usual_materials(), name) == nullptr)
      throw unknown_material(file, scene.bodies[i].name, name);
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

/// The key that gives a number of the kinetics: its own, or that of a named set.
const auto& given_kinetics(const std::map<std::string, Given>& values, const std::string& name) {
  const auto own = values.find(name);
  return *(own != values.end() ? own : values.find("kinetics.set"));
}

/// Throws that of a key of [kinetics] by which the charge would not react as its own material does. Studies
/// may set the ignition temperature, which is also a constant of calibrations.
void check_kinetics_of(const NamedMaterial& material, const SceneFile& file) {
  static const std::vector<Key<Charge>> keys = Charge::parameters();
  const Charge own = law_with<Charge>(material);
  Charge stated = own;
  for (const Key<Charge>& key : keys) {
    const Given* given = find_in(file.given, key.name);
    if (given == nullptr || !key.name.starts_with("kinetics.")) continue;
    if (given->place.file == file.file || key.role().part != keys::Part::calibrated)
      key.set(stated, given->value);
  }
  for (const Key<Charge>& key : keys) {
    if (!key.name.starts_with("kinetics.") || key.kind == KeyKind::word || key.get(stated) == key.get(own))
      continue;
    const auto& [name, given] = given_kinetics(file.given, key.name);
    const Place& of_material = given_kinetics(material.values, key.name).second.place;
    throw error_at(
        given.place, name,
        fmt::format("{} = {} beside {} of the material \"{}\"", key.name, format_value(key, key.get(stated)),
                    format_value(key, key.get(own)), material.name),
        fmt::format("the kinetics of the charge's material alone, {}:{}", of_material.file,
                    of_material.line));
  }
}

/// The named material as the scene's material of its law. A number that is the program's own is no given one:
/// what rests on defaults, such as the constants of a calibration, stays as it is.
void use_as_law(const NamedMaterial& material, SceneFile& file, Scene& scene) {
  if (material.law == Charge::name) check_kinetics_of(material, file);
  std::vector<Source> sources = material.sources;
  materials::for_each_law([&]<class Law>(const Law& usual) {
    if (material.law != Law::name) return;
    static const std::vector<Key<Law>> keys = Law::parameters();
    for (const Key<Law>& key : keys) {
      const Given* given = find_in(material.values, key.name);
      if (given == nullptr) continue;
      if (scene_gives(file, key.name))
        forget_source(sources, key.name);
      else if (given->value != key.get(usual) || (key.is_written && !key.is_written(usual)))
        file.given[key.name] = *given;
    }
  });
  const std::string title = material.law + ".title";
  if (!material.title.empty() && !scene_gives(file, title))
    file.given[title] = {material.place, Value(material.title), true};
  scene.sources.insert(scene.sources.end(), sources.begin(), sources.end());
}

/// The named material beside another one of its law.
void add_beside(const NamedMaterial& material, Scene& scene) {
  materials::for_each_law([&]<class Law>(const Law&) {
    if (material.law == Law::name)
      scene.materials.push_back({material.name, law_with<Law>(material), material.title});
  });
  for (Source source : material.sources) {
    for (std::string& key : source.keys)
      key = fmt::format("material.{}.{}", material.name, key_in_material(material.law, key));
    scene.sources.push_back(std::move(source));
  }
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
                     fmt::format("[material.NAME] of each, or a body of material \"{}\"", law));
}

/// Of the file's own material, which may have other numbers than the shipped one.
void set_number(SceneFile& file, const std::string& name, const KeyDescription& key, const Value& value) {
  if (find_named(file.materials, name) == nullptr) file.materials.push_back(*find_named_material(file, name));
  NamedMaterial& material = *std::ranges::find(file.materials, name, &NamedMaterial::name);
  for (const std::string& overridden : key.overrides) material.values.erase(overridden);
  Given& given = material.values[key.name];
  if (given.value != value) forget_source(material.sources, key.name);
  given = {material.place, value, true};
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
        law | always_plausible("the numbers are judged"),
        text_key("title", Standing::input, "What the material is, for reports.", "PBX 9501",
                 &NamedMaterial::title) |
            always_plausible("it is for people"),
        text_key("like", Standing::input, "Material whose values stand for those that are not given here.",
                 "comp-b", &NamedMaterial::like) |
            always_plausible("the numbers are judged")};
  }();
  return keys;
}

const KeyDescription& material_file_key() {
  static const KeyDescription key =
      text_key<std::string>(
          "material_file", Standing::input,
          "File with tables [material.NAME] and [contact.NAME], by its path from the scene's folder.",
          "explosives.toml", std::identity{}) |
      always_plausible("the numbers are judged");
  return key;
}

std::string key_in_material(std::string_view law, std::string_view scene_key) {
  const bool own =
      scene_key.starts_with(law) && scene_key.size() > law.size() && scene_key[law.size()] == '.';
  return std::string(own ? scene_key.substr(law.size() + 1) : scene_key);
}

std::vector<NamedMaterial> read_materials(const toml::table& root, const std::string& file,
                                          const std::vector<NamedMaterial>& known) {
  std::vector<NamedMaterial> materials;
  const auto read = [&](const std::string& name, const toml::table& table) {
    check_name(table, name, file, known);
    materials.push_back(within("material." + name, [&] { return read_material(name, table, file); }));
  };
  visit_tables(root, "material", "that bodies refer to", file, read);
  std::vector<bool> done(materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) complete(materials, i, done, known);
  return materials;
}

const NamedMaterial* find_named_material(const SceneFile& file, const std::string& name) {
  for (const auto* list : {&file.materials, &shipped_materials()})
    if (const NamedMaterial* found = find_named(*list, name)) return found;
  return nullptr;
}

std::vector<Key<SceneFile>> keys_of_used_materials(const SceneFile& file) {
  std::vector<Key<SceneFile>> keys;
  for (const std::string& name :
       std::set<std::string>(file.body_materials.begin(), file.body_materials.end())) {
    const NamedMaterial* named = find_named_material(file, name);
    if (named == nullptr) continue;
    materials::for_each_law([&]<class Law>(const Law&) {
      if (named->law != Law::name) return;
      for (const Key<Law>& key : Law::parameters()) {
        const KeyDescription own = key;
        Key<SceneFile>& lifted = keys.emplace_back(Key<SceneFile>{own});
        lifted.name = fmt::format("material.{}.{}", name, key_in_material(Law::name, key.name));
        lifted.overrides.clear();
        lifted.set = [name, own](SceneFile& owner, const Value& value) {
          set_number(owner, name, own, value);
        };
        lifted.get = [name, own, usual = key.default_value()](const SceneFile& owner) {
          const Given* given = find_in(find_named_material(owner, name)->values, own.name);
          return given == nullptr ? usual : given->value;
        };
      }
    });
  }
  return keys;
}

std::string kinetics_origin(const SceneFile& file) {
  const auto at = [](const std::string& what, const Place& place) {
    const std::string name = std::filesystem::path(place.file).filename().string();
    return fmt::format("{} ({}:{})", what, name, place.line);
  };
  const Given* set = find_in(file.given, "kinetics.set");
  std::vector<std::string> origins{
      set ? at(fmt::format("named set \"{}\"", std::get<std::string>(set->value)), set->place)
          : fmt::format("named set \"{}\", the default", Charge{}.kinetics.name)};
  std::string prefix;
  for (const std::string& name : file.body_materials) {
    const NamedMaterial* material = find_named_material(file, name);
    if (material == nullptr || material->law != Charge::name) continue;
    origins.front() = at(fmt::format("material \"{}\"", name), material->place);
    prefix = fmt::format("material.{}.", name);
  }
  for (const char* number : {"activation_temperature", "frequency", "heat_of_reaction"}) {
    const std::string key = fmt::format("{}kinetics.{}", prefix, number);
    const Place place = place_of_key(file, key);
    if (place.line > 0) origins.push_back(at(key, place));
  }
  return fmt::format("{}", fmt::join(origins, "; "));
}

void use_materials(SceneFile& file, Scene& scene) {
  std::erase_if(file.given, [](const auto& each) { return each.second.of_material; });
  scene.sources = file.sources;
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
        use_as_law(*named, file, scene);
      else
        add_beside(*named, scene);
    }
  }
}

}  // namespace launchsafe::scene
