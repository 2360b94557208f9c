// What the shares of a verdict's uncertainty are, in words.
#pragma once

#include "launchsafe/study/study_file.hpp"

#include <string>

namespace launchsafe::study {

/// Where the share of the calibrated constants comes from and how it grows; a sentence without its subject.
std::string fit_uncertainty_text(const Study& study);
/// Likewise for other models of the launch.
std::string model_form_uncertainty_text(const StudyFile& study);
/// Likewise for what is not known of the launch.
std::string input_uncertainty_text(const Study& study);

}  // namespace launchsafe::study
