#include "launchsafe/scene/load_shape.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace launchsafe::scene {

TurningTimes turning_times(double peak_time, double exponent) {
  const double doubled = 2.0 * exponent;  // N
  // Trigonometric roots of the cubic; its three are real for N > 1.
  const double angle = std::acos(-1.0 / std::sqrt(doubled));
  const auto root = [&](double turns) {
    return 2.0 * std::sqrt(doubled) * std::cos((angle - turns * 2.0 * std::numbers::pi) / 3.0);
  };
  const auto time = [&](double w) { return peak_time * (1.0 - w / doubled); };
  return {std::max(0.0, time(root(0.0))), time(root(2.0))};
}

std::optional<double> exponent_for(double peak_time, double between) {
  constexpr double lowest = 1.0, highest = 1000.0;
  const auto excess = [&](double exponent) { return turning_times(peak_time, exponent).between() - between; };
  const double at_lowest = excess(lowest), at_highest = excess(highest);
  // Written so that what is not a number gives none.
  if (!(at_lowest >= 0.0 && at_highest <= 0.0)) return std::nullopt;
  std::uintmax_t iterations = 100;
  const auto [left, right] =
      boost::math::tools::toms748_solve(excess, lowest, highest, at_lowest, at_highest,
                                        boost::math::tools::eps_tolerance<double>(46), iterations);
  return 0.5 * (left + right);
}

}  // namespace launchsafe::scene
