#include "launchsafe/study/fit.hpp"

#include <cmath>

namespace launchsafe::study {
namespace {

Line line_through(double intercept, double slope, const std::vector<double>& gaps_cm,
                  const std::vector<double>& temperatures) {
  Line line{intercept, slope, {}, 0};
  double sum = 0;
  for (std::size_t i = 0; i < gaps_cm.size(); ++i) {
    const double residual = temperatures[i] - (intercept + slope * gaps_cm[i]);
    line.residuals.push_back(residual);
    sum += residual * residual;
  }
  line.root_mean_square = std::sqrt(sum / static_cast<double>(gaps_cm.size()));
  return line;
}

}  // namespace

std::optional<GapFit> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures,
                               const ReferenceLine& published) {
  std::vector<double> gaps_cm;
  for (const double gap : gaps) gaps_cm.push_back(100.0 * gap);
  const auto fitted = math::fit_line(gaps_cm, temperatures);
  if (!fitted) return std::nullopt;
  GapFit fit{gaps, *fitted, {}, {}, {}};
  const double slope = fitted->coefficients[1];
  fit.ordinary = line_through(fitted->coefficients[0], slope, gaps_cm, temperatures);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] == 0.0) fit.mixed = line_through(temperatures[i], slope, gaps_cm, temperatures);
  }
  if (published.given())
    fit.published = line_through(published.intercept, published.slope, gaps_cm, temperatures);
  return fit;
}

}  // namespace launchsafe::study
