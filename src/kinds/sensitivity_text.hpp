// What the tables, the page and the pictures of a sensitivity study share.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"

#include <string>
#include <vector>

namespace launchsafe::kinds {

/// How an output is shown.
struct ShownOutput {
  report::Column column;  ///< its name is also that of its picture's file
  std::string phrase;     ///< "T max", "the margin": within a sentence

  double value(double value_si) const { return report::shown_value(value_si, column.form); }
};
const ShownOutput& shown_output(SensitivityOutput output);

/// An input as people read it.
struct ShownInput {
  std::string name;          ///< "peak pressure"
  std::string distribution;  ///< "uniform from 400 to 600 MPa"
};
std::vector<ShownInput> shown_inputs(const study::Study& study);

/// " at a gap of 0.02 cm", for outputs that belong to the study's gap.
std::string at_gap(const study::Study& study, SensitivityOutput output);

/// "0.52 [0.4, 0.63]".
std::string estimate_text(const math::Estimate& estimate);

/// Method, design, N, evaluations, seed and confidence in a sentence or two.
std::string method_text(const SensitivityResult& result);

}  // namespace launchsafe::kinds
