#include "input_text.hpp"
#include "scene_file.hpp"

#include <fmt/format.h>

#include <set>

namespace launchsafe::scene {
namespace {

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

/// The named material as the scene's material of its law. A number that is the program's own is no given one:
/// what rests on defaults, such as the constants of a calibration, stays as it is.
void use_as_law(const NamedMaterial& material, SceneFile& file, Scene& scene) {
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
  materials::for_each_law([&]<class Law>(Law law) {
    if (material.law != Law::name) return;
    for (const Key<Law>& key : Law::parameters())
      if (const Given* given = find_in(material.values, key.name)) key.set(law, given->value);
    scene.materials.push_back({material.name, law, material.title});
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
