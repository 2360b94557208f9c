// [[settings]] of an accuracy study, its reference meshes, and the cases that follow from both.
#pragma once

#include "study_faults.hpp"

namespace launchsafe::study::detail {

/// Reads [[settings]] into Study::settings and sorts the reference meshes, finest first. Needs the study's
/// scene and overrides.
Fault read_settings(const toml::table& root, StudyFile& study);

/// The reference meshes, finest first; the scene as it is; every combination of each [[settings]]. A case
/// that an earlier one equals is left out.
Fault make_accuracy_cases(StudyFile& study);

}  // namespace launchsafe::study::detail
