#include "launchsafe/study/study_faults.hpp"

#include <fmt/format.h>

namespace launchsafe::study {
namespace {

using Tables = std::vector<const toml::table*>;

scene::Expected<Tables> listed_tables(const toml::table& root, const std::string& name,
                                      const std::string& file, const std::string& allowed) {
  Tables tables;
  const toml::node* node = root.get(name);
  if (!node || (node->is_array() && node->as_array()->empty())) return tables;
  if (!node->is_array_of_tables())
    return scene::error_at(scene::place_of(*node, file), name, scene::found_text(*node), allowed);
  for (const toml::node& element : *node->as_array()) tables.push_back(element.as_table());
  return tables;
}

}  // namespace

scene::Expected<Tables> tables_of(const toml::table& root, const std::string& name, const std::string& file) {
  return listed_tables(root, name, file, fmt::format("tables, each written [[{}]]", name));
}

scene::Expected<Tables> some_tables_of(const toml::table& root, const std::string& name,
                                       const StudyFile& study, const std::string& content) {
  const std::string allowed = fmt::format("at least one table, written [[{}]], {}", name, content);
  auto tables = listed_tables(root, name, study.file, allowed);
  if (!tables || !tables->empty()) return tables;
  return scene::error_at(place_of_key(study, root.contains(name) ? name : "kind"), name, "no " + name,
                         allowed);
}

scene::Expected<std::string> read_named_file(const StudyFile& study, const std::filesystem::path& folder,
                                             const std::string& key, const std::string& name,
                                             const std::string& wanted) {
  auto text = scene::read_text_file(folder / name);
  if (text) return text;
  return fault_at(study, key, fmt::format("\"{}\", which cannot be read", name),
                  wanted + ", by its path from the study file's folder", text.error().suggestion);
}

}  // namespace launchsafe::study
