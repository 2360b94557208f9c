// Sensitivity by a fit: the points where the launch is computed, the fit, its error, and the launches that
// are added until that is as small as is asked.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"

#include <vector>

namespace launchsafe::kinds {

/// Points of the unit cube of the axes, row by row: those of a Saltelli design, or those that are fitted and
/// then independent ones that are held out.
std::vector<double> design_points(const study::Study& study);

/// The fit of an output that has its values, to the evaluations that are fitted.
study::SurrogateOutput fit_of(const SensitivityResult& result, const OutputSensitivity& output);

/// Fits an output, and finds its indices: of a polynomial by its terms, of a process by
/// differences. Their intervals are widened by the share of the variance that the fit does not explain. None
/// where nothing is predicted (study::fit_output).
void estimate_by_chaos(const SensitivityResult& result, OutputSensitivity& output);

/// The values of an output of all cases, without indices and fit.
OutputSensitivity values_of(const SensitivityResult& result, SensitivityOutput which);

/// Adds launches to a result that has those of its design, until the errors that are asked are reached or
/// there are as many as may be. None without an error that is asked, of a shard, or where runs are not stored
/// and may not be computed.
void add_launches(SensitivityResult& result, const study::StudyOptions& options);

/// What was fitted, for `launchsafe ask`. Of a study that has its outputs.
study::SurrogateRecord surrogate_record(const SensitivityResult& result);

}  // namespace launchsafe::kinds
