// What is wrong with a study, and where.
#pragma once

#include "launchsafe/study/study_file.hpp"

#include <optional>
#include <string>
#include <utility>

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

}  // namespace launchsafe::study
