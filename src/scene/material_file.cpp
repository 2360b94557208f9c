// Files of materials and contacts, and those that ship.
#include "built_in_materials.hpp"
#include "launchsafe/scene/decomposition.hpp"
#include "launchsafe/scene/input_content.hpp"
#include "launchsafe/scene/named_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace launchsafe::scene {
namespace {

bool is_shipped(const std::string& text) {
  const std::vector<BuiltInText>& texts = built_in_materials();
  return std::any_of(texts.begin(), texts.end(), [&](const BuiltInText& each) { return each.text == text; });
}

/// What `read(table, file, those of the files before)` finds in all of them. A fault is one of the program
/// itself, which tests find.
template <class Named, class Read>
std::vector<Named> read_built_in(Read&& read) {
  std::vector<Named> all;
  for (const BuiltInText& each : built_in_materials()) {
    const std::string file = "the shipped " + each.file;
    const auto table = parse_toml(each.text, file);
    auto named = table ? read(*table, file, all) : Expected<std::vector<Named>>(table.error());
    if (!named) {
      fmt::print(stderr, "{}\n", named.error().message());
      std::abort();
    }
    all.insert(all.end(), named->begin(), named->end());
  }
  return all;
}

/// Those of the shipped ones that the file names.
template <class Named>
std::vector<Named> named_in(const toml::table& root, const char* what, const std::vector<Named>& shipped) {
  std::vector<Named> own;
  const toml::table* tables = root[what].as_table();
  for (const Named& each : shipped)
    if (tables != nullptr && tables->contains(each.name)) own.push_back(each);
  return own;
}

}  // namespace

std::optional<InputError> check_material_tables(const toml::table& root, const std::string& file) {
  if (auto read = read_described(root, {}, {"material", "contact"}, file); !read) return read.error();
  return std::nullopt;
}

const std::vector<NamedMaterial>& shipped_materials() {
  static const std::vector<NamedMaterial> all = read_built_in<NamedMaterial>(read_materials);
  return all;
}

const std::vector<NamedContact>& shipped_contacts() {
  static const std::vector<NamedContact> all = read_built_in<NamedContact>(read_contacts);
  return all;
}

const std::vector<Decomposition>& shipped_decompositions() {
  static const std::vector<Decomposition> all = read_built_in<Decomposition>(read_decompositions);
  return all;
}

Expected<NamedMaterials> read_material_file(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  const auto table = parse_toml(*text, file.string());
  if (!table) return table.error();
  if (auto error = check_content(*table, file.string(), InputContent::materials)) return *error;
  if (is_shipped(*text))
    return NamedMaterials{named_in(*table, "material", shipped_materials()),
                          named_in(*table, "contact", shipped_contacts()),
                          named_in(*table, "decomposition", shipped_decompositions())};
  if (auto error = check_material_tables(*table, file.string())) return *error;
  auto materials = read_materials(*table, file.string(), shipped_materials());
  if (!materials) return materials.error();
  auto contacts = read_contacts(*table, file.string(), shipped_contacts());
  if (!contacts) return contacts.error();
  return NamedMaterials{std::move(*materials), std::move(*contacts), {}};
}

}  // namespace launchsafe::scene
