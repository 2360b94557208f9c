// The numerical uncertainty of every case of a study: stated, from an accuracy record, or assumed.
#pragma once

#include "launchsafe/study/accuracy_record.hpp"
#include "launchsafe/study/study_faults.hpp"

#include <filesystem>

namespace launchsafe::study {

/// The record that a study names, if it names one. Faults: none there, no record, or a stated uncertainty
/// beside it.
scene::Expected<std::optional<AccuracyRecord>> read_record(const StudyFile& study,
                                                           const std::filesystem::path& folder);

/// Puts the cheapest recorded setting within the tolerance (K) into the study's scene. Needs the overrides.
Fault choose_setting(StudyFile& study, const std::optional<AccuracyRecord>& record, double tolerance);

/// Numerical uncertainty of the study and of each of its cases. Without a statement, or elsewhere than it
/// holds, nothing is known, and a large one is assumed, so that no verdict is SAFE on the strength of
/// silence.
void settle_uncertainty(StudyFile& study, const std::optional<AccuracyRecord>& record);

/// K, of T max of a gap (m) by mesh, step and scaling, where T max is `rise` (K) above the initial
/// temperature.
double numerical_share(const StudyCase& input, double gap, double rise);

}  // namespace launchsafe::study
