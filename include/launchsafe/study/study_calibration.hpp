// The constants of a study from the record of a calibration, and what a record says of other models.
#pragma once

#include "launchsafe/study/study_faults.hpp"
#include "launchsafe/study/study_file.hpp"

#include <filesystem>

namespace launchsafe::study {

/// Reads the record that a study names, if it names one, gives its load and constants to the scene, and notes
/// them among the overrides. A fit uncertainty that the study does not state becomes the record's.
Fault use_calibration(StudyFile& study, const std::filesystem::path& folder);

/// Reads the record of other models that a study names, if it names one.
Fault read_model_form(StudyFile& study, const std::filesystem::path& folder);

}  // namespace launchsafe::study
