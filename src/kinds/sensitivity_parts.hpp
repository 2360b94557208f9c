// What the sources of a sensitivity study share: how things are called; its points, fits and added launches;
// and what the samples say of the outputs themselves. Only the samples of Saltelli's matrices A and B are
// draws from the distributions of the inputs; the mixed ones are made for differences.
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

/// Points of the unit cube of the axes, row by row: those of a Saltelli design, or those that are fitted and
/// then independent ones that are held out.
std::vector<double> design_points(const Study& study);

/// Fits an output, and finds its indices: of a polynomial by its terms, of a process by
/// differences. Their intervals are widened by the share of the variance that the fit does not explain. None
/// where nothing is predicted (study::fit_output).
void estimate_by_chaos(const SensitivityResult& result, OutputSensitivity& output);

/// The values of an output of all cases, without indices and fit.
OutputSensitivity values_of(const SensitivityResult& result, SensitivityOutput which);

/// Adds launches to a result that has those of its design, until the errors that are asked are reached or
/// there are as many as may be. None without an error that is asked, of a shard, or where runs are not stored
/// and may not be computed.
void add_launches(SensitivityResult& result, const StudyOptions& options, study::ProgressTracker& tracker);

/// What was fitted, for `launchsafe ask`. Of a study that has its outputs.
study::SurrogateRecord surrogate_record(const SensitivityResult& result);

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
