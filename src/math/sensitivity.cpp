#include "launchsafe/math/sensitivity.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace launchsafe::math {
namespace {
/// Quantile of sorted values, linear between them; the first and last belong to 0 and 1.
double sorted_quantile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), sorted.size() - 1);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double rest = position - static_cast<double>(below);
  return (1.0 - rest) * sorted[below] + rest * sorted[above];
}

}  // namespace

std::vector<double> resampling_counts(std::size_t size, SplitMix64& random) {
  std::vector<double> counts(size, 0.0);
  for (std::size_t k = 0; k < size; ++k) counts[random.below(static_cast<std::uint32_t>(size))] += 1.0;
  return counts;
}

Estimate with_interval(double value, std::vector<double> replicates, std::size_t size, double level) {
  if (replicates.empty() || size < 2) return {value, no_estimate.lower, no_estimate.upper};
  const double members = static_cast<double>(size);
  const double student = boost::math::quantile(boost::math::students_t(members - 1.0), 0.5 * (1.0 - level));
  const double tail = boost::math::cdf(boost::math::normal(), student * std::sqrt(members / (members - 1.0)));
  std::ranges::sort(replicates);
  return {value, sorted_quantile(replicates, tail), sorted_quantile(replicates, 1.0 - tail)};
}

}  // namespace launchsafe::math
