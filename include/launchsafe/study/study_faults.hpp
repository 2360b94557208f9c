// What is wrong with a study and where, and what it reads besides its keys.
#pragma once

#include "launchsafe/study/study_file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::study {

using Fault = std::optional<scene::InputError>;

/// Where the user gave a key; the file as a whole if he did not.
inline scene::Place place_of_key(const StudyFile& study, const std::string& key) {
  const auto found = study.places.find(key);
  return found == study.places.end() ? scene::Place{study.file} : found->second;
}

inline scene::InputError fault_at(const StudyFile& study, const std::string& key, std::string found,
                                  std::string allowed, std::string suggestion = {}) {
  return scene::error_at(place_of_key(study, key), key, std::move(found), std::move(allowed),
                         std::move(suggestion));
}

/// A key of a table that was read by itself, named as of the whole file: `table`.key.
inline scene::InputError in_table(scene::InputError error, const std::string& table) {
  error.key = table + "." + error.key;
  return error;
}

/// The tables [[name]] of a study file or of a file that it names; none where there are none. A kind that
/// needs at least one says what stands in it: "with a name".
scene::Expected<std::vector<const toml::table*>> tables_of(const toml::table& root, const std::string& name,
                                                           const std::string& file);
scene::Expected<std::vector<const toml::table*>> some_tables_of(const toml::table& root,
                                                                const std::string& name,
                                                                const StudyFile& study,
                                                                const std::string& content);

/// The text of the file that a key names by its path from the study file's folder; `wanted` says which file
/// that should be.
scene::Expected<std::string> read_named_file(const StudyFile& study, const std::filesystem::path& folder,
                                             const std::string& key, const std::string& name,
                                             const std::string& wanted);

}  // namespace launchsafe::study
