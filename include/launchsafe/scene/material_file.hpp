// A file of materials and contacts, which a scene names by `material_file`.
#pragma once

#include "launchsafe/scene/named_contact.hpp"
#include "launchsafe/scene/named_material.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::scene {

struct NamedMaterials {
  std::vector<NamedMaterial> materials;
  std::vector<NamedContact> contacts;
};

/// The first key of a file of materials that is no table of it.
std::optional<InputError> check_material_tables(const toml::table& root, const std::string& file);

/// What ships with the program.
NamedMaterials shipped_named_materials();

/// The file's own. A shipped file gives what it ships; others must not take its names. Faults: those of
/// `read_materials` and `read_contacts`, a key beside the tables, a scene or a study.
Expected<NamedMaterials> read_material_file(const std::filesystem::path& file);

}  // namespace launchsafe::scene
