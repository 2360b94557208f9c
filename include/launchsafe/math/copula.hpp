// Draws of uncertain inputs that are not independent of each other.
#pragma once

#include "launchsafe/math/sampling.hpp"

namespace launchsafe::math {

/// The smallest eigenvalue of a symmetric matrix of so many rows, row by row.
double smallest_eigenvalue(const std::vector<double>& matrix, std::size_t rows);

/// Draws of shares, points of the open unit cube, whose normal scores are correlated: a Gaussian copula,
/// under which every share stays uniform. Some may be fixed; the others are then drawn as they are beside
/// those.
class CopulaDraws {
 public:
  /// A correlation matrix that is positive definite, row by row; empty: all are independent. Of every share
  /// the fixed one, if it is.
  CopulaDraws(const std::vector<double>& correlation, std::vector<std::optional<double>> fixed);

  /// The draw that a point of independent shares stands for.
  std::vector<double> at(std::vector<double> point) const;

 private:
  std::vector<std::optional<double>> fixed_;
  std::vector<std::size_t> order_;  ///< those that are fixed before the others
  std::vector<double> factor_;      ///< of the correlations in that order
};

}  // namespace launchsafe::math
