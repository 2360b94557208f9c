// Maximum temperature against gap as a straight line.
#pragma once

#include "launchsafe/math/statistics.hpp"
#include "launchsafe/study/study_file.hpp"

#include <optional>
#include <vector>

namespace launchsafe::study {

/// T = intercept + slope * gap, gap in cm as the paper prints it.
struct Line {
  double intercept = not_a_number;         ///< K
  double slope = not_a_number;             ///< K/cm
  std::vector<double> residuals;           ///< K, data minus line
  double root_mean_square = not_a_number;  ///< K, of the residuals
};

struct GapFit {
  std::vector<double> gaps;          ///< m
  math::LeastSquares least_squares;  ///< coefficients: intercept (K), slope (K/cm)
  Line ordinary;                     ///< the same as a line
  std::optional<Line> mixed;  ///< slope of least squares through the zero-gap row; only where there is one
  std::optional<Line> published;  ///< the study's reference line
};

/// Nothing for fewer than two gaps, or numbers that are not finite.
std::optional<GapFit> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures,
                               const ReferenceLine& published = {});

}  // namespace launchsafe::study
