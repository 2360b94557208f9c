// An output of independent inputs fitted to few evaluations, with its own error: as a sum of orthonormal
// polynomials (polynomial chaos), or as a straight line and correlated deviations from it (a Gaussian
// process).
#pragma once

#include "launchsafe/math/sensitivity.hpp"

namespace launchsafe::math {

/// The polynomials that are orthonormal under the distribution of an input, whose place u in the open unit
/// interval is the share of the distribution below it.
enum class ChaosBasis {
  legendre,  ///< of 2 u - 1, for uniform and log-uniform inputs
  hermite    ///< of the standard normal at u, for normal and log-normal ones
};

/// Where an input stands in its polynomials: 2 u - 1, or the standard normal at u.
double coordinate(ChaosBasis basis, double u);

/// Points and values of the rows whose value is finite.
struct FiniteRows {
  std::vector<double> points, values;
};
FiniteRows finite_rows(std::size_t inputs, const std::vector<double>& points,
                       const std::vector<double>& values);

/// A fit at a point.
struct FitValue {
  double value = 0;  ///< the output's unit
  /// How far the point lies from those that were fitted, as the fit weighs them.
  double leverage = 0;
};

/// A fit as a sum of functions of a point.
struct FittedForm {
  std::vector<double> weights;  ///< of the functions
  std::vector<double> matrix;   ///< symmetric: of their products in the leverage
  double offset = 0;            ///< of the leverage

  FitValue at(const std::vector<double>& functions) const;
};

/// No polynomial has a higher degree.
inline constexpr int highest_chaos_degree = 20;

/// A product of polynomials, one of each input, with its coefficient in the output's unit.
struct ChaosTerm {
  std::vector<int> degrees;
  double coefficient = 0;
};

struct PolynomialChaos {
  std::vector<ChaosBasis> inputs;
  std::vector<ChaosTerm> terms;  ///< the mean first
  int degree = 0;                ///< highest sum of degrees among which the terms were chosen
  std::size_t points = 0;        ///< that were fitted
  /// Root mean square of what the points miss a fit to all others by, corrected for the number of terms
  /// (Blatman & Sudret 2011, eq. 20); the output's unit.
  double leave_one_out = 0;
  std::string reason;  ///< why there is no fit; empty where there is one

  double mean() const { return terms.front().coefficient; }
  double variance() const;
};

/// The least number of points for a fit: 8, or two per input.
std::size_t fewest_chaos_points(std::size_t inputs);

/// The output fitted at points of the open unit cube, row by row, to its values there: by least squares with
/// terms that orthogonal matching pursuit picks one after the other, up to the number and the degree that
/// leave the least leave-one-out error (Blatman & Sudret, J. Comput. Phys. 230 (2011) 2345, who pick by least
/// angles), of degrees with no more than three candidates a point. Rows whose value is not finite are left
/// out. No fit from fewer than `fewest_chaos_points`.
PolynomialChaos fit_chaos(const std::vector<ChaosBasis>& inputs, const std::vector<double>& points,
                          const std::vector<double>& values);

/// A polynomial with the points that it was fitted to, which say how far it reaches.
class FittedChaos {
 public:
  /// Of the points, row by row. Their values do not matter.
  FittedChaos(PolynomialChaos chaos, const std::vector<double>& points);

  /// Where fitted values err independently by s the fit errs by s sqrt(leverage). Each fitted point has less
  /// than 1, all together have the number of terms.
  FitValue at(const std::vector<double>& point) const;
  /// The terms make the value.
  const FittedForm& form() const { return form_; }

 private:
  PolynomialChaos chaos_;
  FittedForm form_;  ///< with the inverse of the sums of products of the terms
};

/// Sobol indices of groups of inputs, `begins` holding the first input of each and behind them their number:
/// the shares of the variance of the terms that have no other input, and of all that have one of them. The
/// intervals come from a bootstrap: the same terms fitted to points drawn with replacement.
SobolIndices chaos_indices(const PolynomialChaos& chaos, const std::vector<double>& points,
                           const std::vector<double>& values, const std::vector<std::size_t>& begins,
                           const SobolOptions& options = {});

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

/// Lengths and nugget by the greatest restricted likelihood (Patterson & Thompson, Biometrika 58 (1971) 545),
/// which is that of all combinations of the values in which the line does not show. Rows as in `fit_chaos`.
/// No fit from fewer points than that, from more than 256, or of an output that is a
/// straight line.
GaussianProcess fit_process(const std::vector<ChaosBasis>& inputs, const std::vector<double>& points,
                            const std::vector<double>& values);

/// A process with the points that it was fitted to and their values, all finite. Predicts NaN where they
/// leave the line open.
class FittedProcess {
 public:
  FittedProcess(GaussianProcess process, const std::vector<double>& points,
                const std::vector<double>& values);

  /// The leverage is the variance of an evaluation there, over the mean of those that the points have when
  /// they are predicted from all others: universal kriging (Rasmussen & Williams, Gaussian Processes for
  /// Machine Learning (2006), eq. 2.42).
  FitValue at(const std::vector<double>& point) const;
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
  FittedForm form_;
};

}  // namespace launchsafe::math
