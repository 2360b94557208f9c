// The mechanical runs of a study: complete, valid scenes.
#pragma once

#include "study_faults.hpp"

#include <vector>

namespace launchsafe::study::detail {

/// Fills StudyFile::cases, every one of them through scene::with_key. Needs everything else of the study.
Fault make_cases(StudyFile& study);

/// Values (SI) of the inputs at a point of the unit cube, in their order.
std::vector<double> coordinates_of(const std::vector<UncertainInput>& inputs,
                                   const std::vector<double>& unit_point);

}  // namespace launchsafe::study::detail
