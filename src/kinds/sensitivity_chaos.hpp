// Sensitivity by polynomial chaos: the points where the launch is computed, the fit, and its error.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"

#include <vector>

namespace launchsafe::kinds {

/// Points of the unit cube of the axes, row by row: those that are fitted, then independent ones that are
/// held out.
std::vector<double> chaos_points(const study::Study& study);

/// The fit to the values of an output, its error at those that are held out, and the indices, whose intervals
/// are widened by the share of the variance that it does not explain. No indices where that is more than a
/// tenth, or not known from 10 evaluations at least.
void estimate_by_chaos(const study::Study& study, OutputSensitivity& output);

/// What was fitted, for `launchsafe ask`. Of a study that has its outputs.
study::SurrogateRecord surrogate_record(const SensitivityResult& result);

}  // namespace launchsafe::kinds
