// The constants of a study: those that it names take the place of its scene's.
#pragma once

#include "launchsafe/scene/constants.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {

/// The launch that constants were fitted on, and how well it meets what is published.
Calibration calibration_of(const scene::Constants& constants);

/// Gives the study's scene the constants that the study names, if it names any, and notes the launch that the
/// scene's constants were fitted on.
void use_constants(StudyFile& study, const std::filesystem::path& folder);

}  // namespace launchsafe::study
