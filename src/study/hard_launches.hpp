// [[case]] of a stability study.
#pragma once

#include "study_faults.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::study::detail {

/// One [[case]] as read, without its tables of scene keys.
struct HardLaunchText {
  std::string group, name, must_hold, scene, refused;
  double numerical_uncertainty = not_a_number;  ///< K
  double caught_within = 0;                     ///< steps
};
const std::vector<scene::Key<HardLaunchText>>& hard_launch_keys();

/// Reads [[case]] into StudyFile::launches and their runs into StudyFile::cases; nothing for other kinds.
/// Needs the study's scene with its overrides. A key that a scene cannot have is a fault, but in a case of
/// the reader it is what the case is about.
Fault read_hard_launches(const toml::table& root, StudyFile& study, const std::filesystem::path& folder);

}  // namespace launchsafe::study::detail
