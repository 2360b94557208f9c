// [[cited_limit]] of a study file.
#pragma once

#include "launchsafe/study/study_faults.hpp"

#include <vector>

namespace launchsafe::study {

const std::vector<scene::Key<CitedLimit>>& cited_limit_keys();

/// Reads [[cited_limit]] into Study::cited_limits.
Fault read_cited_limits(const toml::table& root, StudyFile& study);

}  // namespace launchsafe::study
