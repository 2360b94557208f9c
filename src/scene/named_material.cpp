#include "launchsafe/scene/named_material.hpp"

#include "input_text.hpp"

#include <fmt/format.h>

namespace launchsafe::scene {
namespace {

/// A key of a law under the name that materials have for it.
struct LawKey {
  std::string scene_key;
  KeyDescription description;
};

std::vector<LawKey> keys_of_law_in_material(const std::string& law) {
  std::vector<LawKey> keys;
  materials::for_each_law([&]<class Law>(const Law&) {
    if (law != Law::name) return;
    for (const Key<Law>& key : Law::parameters()) {
      LawKey& own = keys.emplace_back(LawKey{key.name, key});
      own.description.name = key_in_material(law, key.name);
    }
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
  const std::vector<LawKey> law_keys = keys_of_law_in_material(read_law(table, material.place, file));
  std::vector<const KeyDescription*> described = descriptions_of(material_keys());
  const std::size_t own = described.size();
  for (const LawKey& key : law_keys) described.push_back(&key.description);
  const ReadValues read = read_described(table, described, {"source"}, file).or_throw();
  std::vector<std::string> given;
  std::map<std::string, std::string> scene_key_of;
  for (const auto& [index, value] : read.values) {
    if (index < own) {
      material_keys()[index].set(material, value);
      continue;
    }
    const LawKey& key = law_keys[index - own];
    scene_key_of[given.emplace_back(key.description.name)] = key.scene_key;
    material.values[key.scene_key] = {read.places.at(key.description.name), value, true};
  }
  material.sources = read_sources(table, given, file);
  for (Source& source : material.sources)
    for (std::string& key : source.keys) key = scene_key_of.at(key);
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
bool is_settled(const NamedMaterial& material, const LawKey& key, const std::vector<LawKey>& keys) {
  return std::ranges::any_of(keys, [&](const LawKey& other) {
    return material.values.contains(other.scene_key) &&
           (contains(other.description.overrides, key.scene_key) ||
            contains(key.description.overrides, other.scene_key));
  });
}

/// Takes what a material does not give from the one that it is like, and says so of each value.
void take_over(NamedMaterial& material, const NamedMaterial& from) {
  const std::vector<LawKey> keys = keys_of_law_in_material(material.law);
  const NamedMaterial own = material;
  Source taken{{}, Standing::assumed, "as of " + from.name};
  for (const LawKey& key : keys) {
    const auto value = from.values.find(key.scene_key);
    if (value == from.values.end() || own.values.contains(key.scene_key) || is_settled(own, key, keys))
      continue;
    material.values.insert(*value);
    taken.keys.push_back(key.scene_key);
  }
  if (!taken.keys.empty()) material.sources.push_back(std::move(taken));
}

void check_complete(const NamedMaterial& material) {
  const std::vector<LawKey> keys = keys_of_law_in_material(material.law);
  for (const LawKey& key : keys) {
    if (material.values.contains(key.scene_key) || is_settled(material, key, keys) ||
        !key.description.usual.empty())
      continue;
    throw error_at(material.place, "material." + material.name + "." + key.description.name,
                   "nothing; the key is missing",
                   fmt::format("{}; or like = \"NAME\", a material whose value stands for it",
                               allowed_text(key.description)));
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
  static const KeyDescription key{
      .name = "material_file",
      .kind = KeyKind::text,
      .standing = Standing::input,
      .sentence = "File with tables [material.NAME] and [contact.NAME], by its path from the scene's folder.",
      .example = "explosives.toml",
      .plausible = {.because = "the numbers are judged"}};
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

}  // namespace launchsafe::scene
