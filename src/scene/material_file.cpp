#include "launchsafe/scene/material_file.hpp"

#include "built_in_materials.hpp"
#include "launchsafe/scene/input_content.hpp"

#include <algorithm>

namespace launchsafe::scene {
namespace {

bool is_shipped(const std::string& text) {
  const std::vector<BuiltInText>& texts = built_in_materials();
  return std::any_of(texts.begin(), texts.end(), [&](const BuiltInText& each) { return each.text == text; });
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

NamedMaterials shipped_named_materials() { return {shipped_materials(), shipped_contacts()}; }

Expected<NamedMaterials> read_material_file(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  const auto table = parse_toml(*text, file.string());
  if (!table) return table.error();
  if (auto error = check_content(*table, file.string(), InputContent::materials)) return *error;
  if (is_shipped(*text))
    return NamedMaterials{named_in(*table, "material", shipped_materials()),
                          named_in(*table, "contact", shipped_contacts())};
  if (auto error = check_material_tables(*table, file.string())) return *error;
  auto materials = read_materials(*table, file.string(), shipped_materials());
  if (!materials) return materials.error();
  auto contacts = read_contacts(*table, file.string(), shipped_contacts());
  if (!contacts) return contacts.error();
  return NamedMaterials{std::move(*materials), std::move(*contacts)};
}

}  // namespace launchsafe::scene
