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

/// Of launches drawn from the inputs, those whose critical gap a fit predicts to be no larger than a gap (m):
/// as predicted, and with predictions lowered by the largest error that was found.
struct PredictedIgnitions {
  std::size_t draws = 0, predicted = 0, at_most = 0;
};
PredictedIgnitions predicted_ignitions(const study::Study& study, const SurrogateFit& fit, double gap);

}  // namespace launchsafe::kinds
