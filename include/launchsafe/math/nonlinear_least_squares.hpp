// Nonlinear least squares for residuals that cost much, several of which may be computed at once.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace launchsafe::math {

/// Residuals, each over its standard deviation, at every one of several points; nothing where one of them has
/// none.
using ResidualsAtPoints =
    std::function<std::optional<std::vector<std::vector<double>>>(const std::vector<std::vector<double>>&)>;

enum class FitFailure { none, too_few_residuals, not_computable, singular, does_not_settle };

/// A minimum of the sum of squares, and what the residuals say of the unknowns there.
struct NonlinearFit {
  FitFailure failure = FitFailure::none;  ///< with any other, what follows may be empty
  std::vector<double> unknowns;
  std::vector<double> residuals;
  std::vector<std::vector<double>> jacobian;  ///< [residual][unknown]
  /// (J^T J)^-1, row by row: that of the unknowns where the residuals have unit variance.
  std::vector<double> covariance;
  double condition = 0;  ///< largest over smallest singular value of the Jacobian
  double sum_of_squares() const;
};

/// Fits from `start` by Levenberg-Marquardt (MINPACK's, in Eigen) with a Jacobian of forward differences
/// `step` > 0, in the units of the unknowns, all of them asked for at once. Unknowns should be scaled to
/// matter alike, such as the logarithms of numbers. Settles where a step promises less than 1e-6 of the sum
/// of squares, or of the unknowns. `singular` where the condition is above 1e6: the residuals do not
/// determine all unknowns.
NonlinearFit fit_nonlinear(const ResidualsAtPoints& residuals, const std::vector<double>& start, double step);

/// What one more unknown would do to a fit, to first order.
struct AddedUnknown {
  double change = 0;  ///< of that unknown
  double gain = 0;    ///< by which the sum of squares falls, >= 0
};
/// `column`: derivative of the residuals with respect to it. Nothing where the others can replace it.
std::optional<AddedUnknown> add_unknown(const NonlinearFit& fit, const std::vector<double>& column);

}  // namespace launchsafe::math
