// Every key of a study file.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/study/read_study.hpp"

#include <string>
#include <vector>

namespace launchsafe::study::detail {

/// Keys of the study itself.
const std::vector<scene::Key<Study>>& study_keys();
/// Keys of one [[reference]].
const std::vector<scene::Key<Reference>>& reference_keys();
/// The kind that a key belongs to, or empty for a key of every kind.
std::string kind_of_key(const std::string& name);

}  // namespace launchsafe::study::detail
