// Maximum temperature against gap as a straight line, and what other curves would say of the same rows.
#pragma once

#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/study/study_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// T = intercept + slope * gap, gap in cm as the paper prints it.
struct Line {
  double intercept = not_a_number;         ///< K
  double slope = not_a_number;             ///< K/cm
  std::vector<double> residuals;           ///< K, data minus line
  double root_mean_square = not_a_number;  ///< K, of the residuals
};

/// A curve by least squares, and how well each row follows from the others. NaN where there are too few rows.
struct FittedCurve {
  std::string name;
  int coefficients = 0;
  double root_mean_square = not_a_number;  ///< K, of the residuals
  /// K, of what each row is off the curve through the other rows.
  double left_out = not_a_number;
  /// Akaike's criterion with the correction of Hurvich and Tsai (Biometrika 76, 1989) for few rows.
  double corrected_akaike = not_a_number;
};

struct GapFit {
  std::vector<double> gaps;          ///< m
  std::vector<double> temperatures;  ///< K
  math::LeastSquares least_squares;  ///< coefficients: intercept (K), slope (K/cm)
  Line ordinary;                     ///< the same as a line
  std::optional<Line> mixed;  ///< slope of least squares through the zero-gap row; only where there is one
  std::optional<Line> published;  ///< the study's reference line
  std::vector<double> left_out;   ///< K, of each row less what the line through the others has there
  /// m, where the line reaches the ignition temperature, and half the width of the band of 95 % there; NaN
  /// where it does not rise, or has no band.
  double reaches_ignition = not_a_number, reaches_ignition_half_width = not_a_number;
  /// The straight line, a parabola, and the line with the heat of reaction of a skin at the line's
  /// temperature. None where no line has a row to spare.
  std::vector<FittedCurve> curves;
};

/// Nothing for fewer than two gaps (m), or numbers that are not finite.
std::optional<GapFit> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures,
                               const materials::KineticsParameters& kinetics,
                               const ReferenceLine& published = {});

}  // namespace launchsafe::study
