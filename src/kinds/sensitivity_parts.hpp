// What the sources of a sensitivity study share: how things are called, and what the samples say of the
// outputs themselves. Only the samples of Saltelli's matrices A and B are draws from the distributions of the
// inputs; the mixed ones are made for differences.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using math::Estimate;

/// How an output is shown.
struct ShownOutput {
  Column column;       ///< its name is also that of its picture's file
  std::string phrase;  ///< "T max", "the margin": within a sentence

  double value(double value_si) const { return shown_value(value_si, column.form); }
};
const ShownOutput& shown_output(SensitivityOutput output);

/// " at a gap of 0.02 cm", for outputs that belong to the study's gap.
std::string at_gap(const Study& study, SensitivityOutput output);

/// How many draws ignite at the study's gap, and between what, with 95 %, the probability lies: its ends hold
/// whatever the failed draws would have done.
Row ignition_json(const SensitivityResult& result);
/// The same as a sentence, with the lower quantile of the critical gap.
std::string samples_text(const SensitivityResult& result);

/// The quantiles of critical gap and T max; how many draws every interval of an output has, and how many have
/// no number; that as steps, without panels where no output has two different numbers.
Table quantile_table(const SensitivityResult& result);
Table histogram_table(const SensitivityResult& result);
Plot histogram_plot(const SensitivityResult& result);

}  // namespace launchsafe::kinds
