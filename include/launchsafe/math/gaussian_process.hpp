// A Gaussian process: an output of independent inputs as a straight line and correlated deviations from it,
// fitted to few evaluations.
#pragma once

#include "launchsafe/math/polynomial_chaos.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace launchsafe::math {

/// Deviations from the line whose correlation falls with the distance of two points: of every input by
/// Matern's function of order 5/2 with a length of its own, in `coordinate` of the input.
struct GaussianProcess {
  std::vector<ChaosBasis> inputs = {};
  std::vector<double> lengths = {};  ///< of the inputs
  double nugget = 0;                 ///< variance of an evaluation by itself, share of that of the deviations
  /// Root mean square of what the points miss the prediction from all others by; the output's unit. Lengths
  /// and nugget are those of all points.
  double leave_one_out = 0;
  std::string reason = {};  ///< why there is no fit; empty where there is one
};

/// No process is fitted to more points: the time goes with their cube.
inline constexpr std::size_t most_process_points = 256;

/// Lengths and nugget by the greatest restricted likelihood (Patterson & Thompson, Biometrika 58 (1971) 545),
/// which is that of all combinations of the values in which the line does not show. Rows as in `fit_chaos`.
/// No fit from fewer points than that, from more than `most_process_points`, or of an output that is a
/// straight line.
GaussianProcess fit_process(const std::vector<ChaosBasis>& inputs, const std::vector<double>& points,
                            const std::vector<double>& values);

/// The logarithm of that likelihood with the best variance of the deviations, but for a constant, and its
/// derivatives by the logarithms of the lengths and of the nugget.
struct ProcessLikelihood {
  double value = 0;
  std::vector<double> derivatives;
};
ProcessLikelihood process_likelihood(const GaussianProcess& process, const std::vector<double>& points,
                                     const std::vector<double>& values);

/// A process with the points that it was fitted to and their values, all finite. Predicts NaN where they
/// leave the line open.
class FittedProcess {
 public:
  FittedProcess(GaussianProcess process, const std::vector<double>& points,
                const std::vector<double>& values);

  /// The leverage is the variance of an evaluation there, over the mean of those that the points have when
  /// they are predicted from all others.
  FitValue at(const std::vector<double>& point) const;
  /// Variance of the output there without the nugget; the output's unit squared. Universal kriging (Rasmussen
  /// & Williams, Gaussian Processes for Machine Learning (2006), eq. 2.42).
  double variance_at(const std::vector<double>& point) const;
  /// What the points are above the prediction from all others, by Dubrule's formula (Math. Geol. 15 (1983)
  /// 687); the output's unit.
  const std::vector<double>& left_out_errors() const { return left_out_errors_; }
  /// Correlations with the points, then 1 and the coordinates, make the value.
  const FittedForm& form() const { return form_; }
  /// Of the points, row by row.
  const std::vector<double>& coordinates() const { return coordinates_; }

 private:
  std::vector<double> functions_at(const std::vector<double>& point) const;

  GaussianProcess process_;
  std::vector<double> coordinates_, left_out_errors_;
  double variance_ = 0;           ///< of the deviations
  double left_out_variance_ = 0;  ///< mean, as a share of that
  FittedForm form_;
};

}  // namespace launchsafe::math
