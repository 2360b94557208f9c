// Materials as tables of numbers: a file, or one that ships; and a scene whose bodies are of these.
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// Under their names in a scene.
std::vector<KeyDescription> keys_of_law(const std::string& law) {
  std::vector<KeyDescription> keys;
  materials::for_each_law([&]<class Law>(const Law&) {
    if (law == Law::name) keys = descriptions_of(Law::parameters());
  });
  return keys;
}

/// A number's key as a material has it: "density" for "charge.density"; others keep their table.
std::string key_in_material(const std::string& law, const std::string& scene_key) {
  return scene_key.starts_with(law + ".") ? scene_key.substr(law.size() + 1) : scene_key;
}

/// A table with all numbers of a material.
NamedMaterial read_material(const std::string& name, const toml::table& table, const std::string& file) {
  KeyDescription law_key = keys::description("law", KeyKind::word, Standing::input, "Law of the numbers.");
  law_key.words = names_of(usual_materials());
  const toml::node* node = table.get("law");
  if (node == nullptr)
    throw error_at(place_of(table, file), "law", "nothing; the key is missing", allowed_text(law_key));
  const std::string law = std::get<std::string>(read_value(*node, law_key, file));
  std::vector<KeyDescription> described = keys_of_law(law);
  for (KeyDescription& key : described) {
    key.name = key_in_material(law, key.name);
    key.required = key.usual.empty();
  }
  described.push_back(law_key);
  described.push_back(keys::description("title", KeyKind::text, Standing::input, "Title for reports."));
  NamedMaterial material{name, law, {}, place_of(table, file), {}};
  auto given = read_described(table, described, {}, file);
  if (const Given* title = find_in(given, "title")) material.title = std::get<std::string>(title->value);
  for (const KeyDescription& key : keys_of_law(law))
    if (const Given* number = find_in(given, key_in_material(law, key.name)))
      material.values[key.name] = {number->place, number->value, true};
  return material;
}

/// The material of a name that a scene file knows: of a file that was read, or a shipped one.
const NamedMaterial* find_named_material(const SceneFile& file, const std::string& name) {
  const NamedMaterial* own = find_named(file.materials, name);
  return own != nullptr ? own : find_named(shipped_materials(), name);
}

/// The material that a body names; null for the usual one of a law.
const NamedMaterial* material_of_body(SceneFile& file, const std::string& body, const std::string& name) {
  if (find_named(usual_materials(), name) != nullptr) return nullptr;
  if (const NamedMaterial* known = find_named_material(file, name)) return known;
  const std::string key = "body." + body + ".material";
  if (!name.ends_with(".toml")) {
    std::vector<std::string> names = names_of(usual_materials());
    for (const NamedMaterial& each : shipped_materials()) names.push_back(each.name);
    throw fault_at(file, key, fmt::format("\"{}\", a material that is nowhere described", name),
                   quoted_list(names) + "; or the path of a material's file, which ends with .toml",
                   in_quotes(nearest_of(name, names)));
  }
  const std::string path =
      named_file(file.folder, name, place_of_key(file, key), key, "a TOML file of a material").string();
  return &file.materials.emplace_back(read_material(name, parse_toml(read_text_file(path), path), path));
}

/// Whether the scene itself gives the key, or one that overrides it.
bool scene_gives(const SceneFile& file, const std::string& name) {
  return std::ranges::any_of(file.given, [&](const auto& each) {
    return !each.second.of_material &&
           (each.first == name || contains(find_key(scene_keys(), each.first)->overrides, name));
  });
}

/// Throws that of a key of [kinetics] in the scene's own file by which the charge would not react as its
/// material does.
void check_kinetics_of(const NamedMaterial& material, const SceneFile& file) {
  for (const auto& [name, own] : material.values) {
    const Given* given = find_in(file.given, name);
    if (!name.starts_with("kinetics.") || given == nullptr || given->place.file != file.file ||
        given->value == own.value)
      continue;
    const Key<Scene>& key = *find_key(scene_keys(), name);
    throw error_at(
        given->place, name,
        fmt::format("{} beside {} of the material \"{}\"", format_value(key, given->value),
                    format_value(key, own.value), material.name),
        fmt::format("the kinetics of the charge's material alone, {}:{}", own.place.file, own.place.line));
  }
}

/// The named material as the scene's material of its law. A number that is the program's own is no given one:
/// what rests on defaults, such as the constants of a calibration, stays as it is.
void use_as_law(const NamedMaterial& material, SceneFile& file) {
  if (material.law == Charge::name) check_kinetics_of(material, file);
  static const Scene usual;
  for (const auto& [name, given] : material.values) {
    const Key<Scene>& key = *find_key(scene_keys(), name);
    if (!scene_gives(file, name) && given.value != key.get(usual)) file.given[name] = given;
  }
  const std::string title = material.law + ".title";
  if (!material.title.empty() && !scene_gives(file, title))
    file.given[title] = {material.place, Value(material.title), true};
}

}  // namespace

const std::vector<NamedMaterial>& shipped_materials() {
  static const std::vector<NamedMaterial> all = []() noexcept {  // a fault is one of the program itself
    std::vector<NamedMaterial> read;
    for (const auto& [file, text] : built_in_materials()) {
      const std::string place = "the shipped " + file;
      read.push_back(read_material(std::filesystem::path(file).stem(), parse_toml(text, place), place));
    }
    return read;
  }();
  return all;
}

const NamedMaterial* named_material_of(const SceneFile& file, std::string_view law) {
  for (const std::string& name : file.body_materials)
    if (const NamedMaterial* found = find_named_material(file, name); found != nullptr && found->law == law)
      return found;
  return nullptr;
}

std::string kinetics_origin(const SceneFile& file) {
  const auto at = [](const std::string& what, const Place& place) {
    const std::string name = std::filesystem::path(place.file).filename().string();
    return fmt::format("{} ({}:{})", what, name, place.line);
  };
  const NamedMaterial* material = named_material_of(file, Charge::name);
  std::string origin = "the default";
  if (material != nullptr) origin = at(fmt::format("material \"{}\"", material->name), material->place);
  for (const char* key :
       {"kinetics.activation_temperature", "kinetics.frequency", "kinetics.heat_of_reaction"})
    if (const Given* number = find_in(file.given, key); number != nullptr && !number->of_material)
      origin += "; " + at(key, number->place);
  return origin;
}

void use_materials(SceneFile& file, Scene& scene) {
  std::erase_if(file.given, [](const auto& each) { return each.second.of_material; });
  std::map<std::string, std::string> name_of_law;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string &name = file.body_materials[i], &body = scene.bodies[i].name;
    const NamedMaterial* named = material_of_body(file, body, name);
    scene.bodies[i].material = named == nullptr ? name : named->law;
    const auto& [law, first] = *name_of_law.emplace(scene.bodies[i].material, name).first;
    if (first != name)
      throw fault_at(file, "body." + body + ".material",
                     fmt::format("\"{}\" beside \"{}\", two materials of the law \"{}\"", name, first, law),
                     "one material of a law in a scene");
  }
  for (const auto& [law, name] : name_of_law)
    if (const NamedMaterial* named = find_named_material(file, name)) use_as_law(*named, file);
}

}  // namespace launchsafe::scene
