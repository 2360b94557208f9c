// What the tables, the page and the pictures of a sensitivity study share.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// How an output is shown.
struct ShownOutput {
  std::string name;    ///< "T max"
  std::string phrase;  ///< "T max", "the margin": within a sentence
  std::string key;     ///< "temperature_max", also of its picture's file
  std::string unit;    ///< "K", "cm"
  double scale = 1;    ///< units per SI unit
};
ShownOutput shown_output(SensitivityOutput output);

/// " at a gap of 0.02 cm", for outputs that belong to the study's gap.
std::string at_gap(const study::Study& study, SensitivityOutput output);

/// Whether an output has indices that can be shown.
bool has_indices(const OutputSensitivity& output);
/// Why it has none; empty where it has.
std::string reason_of(const OutputSensitivity& output);

/// Method, design, N, evaluations, seed and confidence in a sentence or two.
std::string method_text(const SensitivityResult& result);

/// What the inputs are ranked by: their total order.
std::vector<math::Estimate> importance_of(const OutputSensitivity& output);

/// Inputs by falling importance in groups: all intervals of a group lie above all of the following groups;
/// within a group the intervals overlap, and its order means nothing.
std::vector<std::vector<std::size_t>> ranked(const std::vector<math::Estimate>& importance);

}  // namespace launchsafe::kinds
