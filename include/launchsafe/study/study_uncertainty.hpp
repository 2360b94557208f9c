// The numerical uncertainty of every case of a study: stated, from an accuracy record, or assumed.
#pragma once

#include "launchsafe/study/accuracy_record.hpp"
#include "launchsafe/study/study_faults.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace launchsafe::study {

/// The record that a study names, if it names one. Faults: none there, no record, or a stated uncertainty
/// beside it.
scene::Expected<std::optional<AccuracyRecord>> read_record(StudyFile& study,
                                                           const std::filesystem::path& folder);

/// Puts the cheapest recorded setting within the tolerance (K) into the study's scene. Needs the overrides.
Fault choose_setting(StudyFile& study, const std::optional<AccuracyRecord>& record, double tolerance);

/// Numerical uncertainty of each case of the study, known once the case is made. Without a statement, or
/// elsewhere than it holds, nothing is known, and a large one is assumed, so that no verdict is SAFE on the
/// strength of silence.
void settle_uncertainty(StudyFile& study, const std::optional<AccuracyRecord>& record);

/// Of all cases of a study, each of which is made for it.
struct NumericalUncertainty {
  double largest = 0;    ///< K, of T max
  bool assumed = false;  ///< for some case
  std::string source;    ///< where it comes from, a clause
};
NumericalUncertainty numerical_uncertainty_of(const StudyFile& study);

/// "it was made at ... (20 of 45 cases); ... (4 of 45 cases)": reasons of some cases, the commonest first.
std::string commonest_first(const std::map<std::string, std::size_t>& reasons, std::size_t cases);

/// K, of T max of a gap (m) by mesh, step and scaling, where T max is `rise` (K) above the initial
/// temperature.
double numerical_share(const StudyCase& input, double gap, double rise);

}  // namespace launchsafe::study
