// An output of independent inputs as a sum of orthonormal polynomials (polynomial chaos), fitted to few
// evaluations, with its own error.
#pragma once

#include "launchsafe/math/sensitivity.hpp"

namespace launchsafe::math {

/// The polynomials that are orthonormal under the distribution of an input, whose place u in the open unit
/// interval is the share of the distribution below it.
enum class ChaosBasis {
  legendre,  ///< of 2 u - 1, for uniform and log-uniform inputs
  hermite    ///< of the standard normal at u, for normal and log-normal ones
};

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

/// Sobol indices of groups of inputs, `begins` holding the first input of each and behind them their number:
/// the shares of the variance of the terms that have no other input, and of all that have one of them. The
/// intervals come from a bootstrap: the same terms fitted to points drawn with replacement.
SobolIndices chaos_indices(const PolynomialChaos& chaos, const std::vector<double>& points,
                           const std::vector<double>& values, const std::vector<std::size_t>& begins,
                           const SobolOptions& options = {});

}  // namespace launchsafe::math
