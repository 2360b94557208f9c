#include "launchsafe/math/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace launchsafe::math {
namespace {

/// Below this order the error falls too slowly for its size to be told (Eca & Hoekstra 2014).
constexpr double lowest_trusted_order = 0.5;
/// Of the methods whose values are extrapolated.
constexpr double formal_order = 2.0;
/// Observed orders scatter; this much above the formal one still counts as it (2.1 for 2 there).
constexpr double order_allowance = 0.1;
constexpr double trusted_safety_factor = 1.25, cautious_safety_factor = 3.0;
/// Half width, in differences between the values, where nothing may be extrapolated.
constexpr double widening = 3.0;

using Values = std::vector<double>;

std::string rounded(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

double range_of(const Values& values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return *highest - *lowest;
}

/// What the last digits of the values may be off by. Positive even where all of them are 0.
double round_off_of(const Values& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return std::max(8.0 * std::numeric_limits<double>::epsilon() * largest, std::numeric_limits<double>::min());
}

/// Empty where the numbers can be used.
std::string fault_of(const Values& values, const Values& sizes) {
  if (values.empty()) return "there are no values";
  if (values.size() != sizes.size()) return "there are not as many sizes as values";
  if (!all_finite(values)) return "a value is not a finite number";
  const bool increasing =
      std::ranges::adjacent_find(sizes, [](double a, double b) { return !(a < b); }) == sizes.end();
  if (!all_finite(sizes) || !(sizes.front() > 0.0) || !increasing)
    return "the sizes are not positive and increasing";
  return {};
}

/// The finest value and a reason why it is not more than that.
Extrapolation finest_of(const Values& values, std::string reason, double order, double uncertainty) {
  return {.reason = std::move(reason),
          .order = order,
          .value = values.empty() ? not_a_number : values.front(),
          .uncertainty = uncertainty};
}

/// Every difference has the other sign than the one before.
bool is_oscillating(const Values& values) {
  for (std::size_t i = 2; i < values.size(); ++i)
    if (!((values[i] - values[i - 1]) * (values[i - 1] - values[i - 2]) < 0.0)) return false;
  return values.size() > 2;
}

std::string reason_of_order(double order) {
  if (!(order > 0.0)) return "the values do not converge";
  if (order < lowest_trusted_order)
    return "the observed order " + rounded(order) + " is below " + rounded(lowest_trusted_order);
  if (!(order < formal_order + order_allowance))
    return "the observed order " + rounded(order) + " is above the formal one, " + rounded(formal_order);
  return {};
}

// --- three values ---

/// Celik's order takes the absolute value of a logarithm, so that a series which diverges has one too: it
/// counts only where the power law with it passes through all three values.
std::optional<GridConvergence> consistent_convergence(const Values& values, const Values& sizes) {
  const auto found = grid_convergence({values[0], values[1], values[2]}, {sizes[0], sizes[1], sizes[2]});
  if (!found || found->oscillating) return found;
  const double r21 = sizes[1] / sizes[0], r31 = sizes[2] / sizes[0];
  const double expected = std::expm1(found->order * std::log(r31)) / std::expm1(found->order * std::log(r21));
  const double actual = (values[2] - values[0]) / (values[1] - values[0]);
  if (!(std::abs(expected / actual - 1.0) < 1e-4)) return std::nullopt;
  return found;
}

/// |phi_1 - phi0| of the power law of a given order through the values `fine` and `fine` + 1.
double finest_error(const Values& values, const Values& sizes, std::size_t fine, double order) {
  const auto power = [&](std::size_t i) { return std::pow(sizes[i] / sizes.front(), order); };
  return std::abs((values[fine + 1] - values[fine]) / (power(fine + 1) - power(fine)));
}

Extrapolation from_three(const Values& values, const Values& sizes) {
  const double widened = widening * range_of(values);
  const auto found = consistent_convergence(values, sizes);
  if (!found) return finest_of(values, "the values do not converge", not_a_number, widened);
  if (found->oscillating) return finest_of(values, "the values oscillate", found->order, widened);

  const std::string reason = reason_of_order(found->order);
  if (found->order < lowest_trusted_order) return finest_of(values, reason, found->order, widened);
  if (!reason.empty()) {
    // Too high to be believed: the formal order, and the factor that Roache (1998) asks for where the order
    // was not observed. By chance the two finest may lie close together, so the coarser pair is asked as
    // well.
    const double error =
        std::max(finest_error(values, sizes, 0, formal_order), finest_error(values, sizes, 1, formal_order));
    return finest_of(values, reason, found->order, cautious_safety_factor * error);
  }
  return {.justified = true,
          .order = found->order,
          .value = found->extrapolated,
          .uncertainty = trusted_safety_factor * finest_error(values, sizes, 0, found->order)};
}

// --- four values and more ---
//
// The formulas of the paper and, for series that do not converge or oscillate, the wider of its half width
// and three times the range. The deviations have n - 3 or n - 2 degrees of freedom. Measured on 2000 made
// series each of 4, 5 and 6 sizes (ratios 1.2 to 2, orders 0.8 to 2), the half width holds the limit, of 100
// times, where the values scatter by a share of the error of the finest one:
//   2 %: 97, 99, 99.9;  5 %: 91, 95, 98;  10 %: 86, 91, 94;  30 %: 83, 87, 89;  100 %: 90, 90, 89.
// Of Celik's three sizes: 90, 82, 79, 81, 91.

/// One series in the size, fitted to the values.
struct Fit {
  double order = 0;      ///< of the power law, or the lowest exponent of a fallback
  double limit = 0;      ///< fitted value at size 0
  double at_finest = 0;  ///< fitted value at the finest size
  double deviation = 0;  ///< sigma, of the residuals with their weights

  /// Estimated error of the finest value by the fit.
  double error() const { return std::abs(at_finest - limit); }
};

/// The weights of a fit, mean 1: all equal, or inverse to the size, so that fine values count more.
Values weights_of(const Values& sizes, bool weighted) {
  Values weights(sizes.size(), 1.0);
  if (!weighted) return weights;
  double sum = 0.0;
  for (const double size : sizes) sum += 1.0 / size;
  for (std::size_t i = 0; i < sizes.size(); ++i)
    weights[i] = static_cast<double>(sizes.size()) / (sizes[i] * sum);
  return weights;
}

/// Least squares with weights: `row_of(size)` gives the regressors, the first of them 1.
template <class RowOf>
std::optional<LeastSquares> weighted_fit(const Values& values, const Values& sizes, const Values& weights,
                                         const RowOf& row_of) {
  std::vector<Values> rows;
  Values scaled;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double root = std::sqrt(weights[i]);
    rows.push_back(row_of(sizes[i] / sizes.front()));
    for (double& regressor : rows.back()) regressor *= root;
    // From the finest value on: only differences carry information, and their digits are few.
    scaled.push_back(root * (values[i] - values.front()));
  }
  return least_squares(rows, scaled);
}

/// Regressors of phi = c0 + c1 (h^p - 1)/p, h in finest sizes. The same curves as phi0 + alpha h^p, but their
/// limit at p = 0, the logarithm, is one of them, so that the search may pass through 0.
Values power_row(double size, double order) {
  const double logarithm = std::log(size);
  return {1.0, order == 0.0 ? logarithm : std::expm1(order * logarithm) / order};
}

/// Where in [low, high] a function with one minimum has it, by golden sections.
template <class Function>
double minimum_between(double low, double high, const Function& function) {
  constexpr double golden = 0.6180339887498949;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = function(left), at_right = function(right);
  for (int step = 0; step < 80 && high - low > 1e-12; ++step) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - golden * (high - low);
      at_left = function(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + golden * (high - low);
      at_right = function(right);
    }
  }
  return 0.5 * (low + high);
}

/// phi0 + alpha h^p. The order is searched for between -3 and 10; at an end of that it is
/// out of the trusted range anyway.
std::optional<Fit> power_fit(const Values& values, const Values& sizes, const Values& weights) {
  const auto fit_with = [&](double order) {
    return weighted_fit(values, sizes, weights, [order](double size) { return power_row(size, order); });
  };
  const auto misfit = [&](double order) {
    const auto fit = fit_with(order);
    return fit ? sum_of_squares(fit->residuals) : infinity;
  };
  constexpr double low = -3.0, high = 10.0, spacing = 0.125;
  double best = low, least = infinity;
  for (double order = low; order <= high; order += spacing) {
    const double sum = misfit(order);
    if (sum < least) {
      best = order;
      least = sum;
    }
  }
  if (!std::isfinite(least)) return std::nullopt;
  const double order = minimum_between(std::max(low, best - spacing), std::min(high, best + spacing), misfit);
  const auto fit = fit_with(order);
  if (!fit) return std::nullopt;
  Fit result;
  result.order = order;
  result.at_finest = values.front() + fit->coefficients[0];
  result.limit = order > 0.0 ? result.at_finest - fit->coefficients[1] / order : not_a_number;
  // The order is a third coefficient, which the linear fit does not count.
  result.deviation = std::sqrt(sum_of_squares(fit->residuals) / static_cast<double>(values.size() - 3));
  return result;
}

/// phi0 + alpha1 h^first (+ alpha2 h^second where that is above 0).
std::optional<Fit> fixed_fit(const Values& values, const Values& sizes, const Values& weights, double first,
                             double second) {
  const auto row_of = [&](double size) {
    Values row{1.0, std::pow(size, first)};
    if (second > 0.0) row.push_back(std::pow(size, second));
    return row;
  };
  const auto fit = weighted_fit(values, sizes, weights, row_of);
  if (!fit) return std::nullopt;
  Fit result;
  result.order = first;
  result.limit = values.front() + fit->coefficients[0];
  result.at_finest = values.front() + fit->at(row_of(1.0));
  result.deviation = fit->residual_deviation;
  return result;
}

void keep_better(std::optional<Fit>& best, const std::optional<Fit>& fit) {
  if (fit && std::isfinite(fit->limit) && (!best || fit->deviation < best->deviation)) best = fit;
}

/// What the power law, with equal weights and with others, says.
struct Observed {
  std::optional<Fit> trusted;  ///< the better of those with an order from 0.5 to the formal one
  double order = 0;            ///< of the better of all; NaN where there is none
  bool too_low = false;        ///< at least one is too low
};

Observed observe(const Values& values, const Values& sizes) {
  Observed observed;
  observed.order = not_a_number;
  double least = infinity;
  for (const bool weighted : {false, true}) {
    const auto fit = power_fit(values, sizes, weights_of(sizes, weighted));
    if (!fit) continue;
    if (fit->order >= lowest_trusted_order && fit->order <= formal_order) keep_better(observed.trusted, fit);
    if (fit->order < lowest_trusted_order) observed.too_low = true;
    if (fit->deviation < least) {
      least = fit->deviation;
      observed.order = fit->order;
    }
  }
  if (observed.trusted) observed.order = observed.trusted->order;
  return observed;
}

/// The best of the series with given exponents: first order and the formal one, and both together where the
/// observed order is too low.
std::optional<Fit> fallback_fit(const Values& values, const Values& sizes, bool too_low) {
  std::optional<Fit> best;
  for (const bool weighted : {false, true}) {
    const Values weights = weights_of(sizes, weighted);
    keep_better(best, fixed_fit(values, sizes, weights, 1.0, 0.0));
    keep_better(best, fixed_fit(values, sizes, weights, formal_order, 0.0));
    if (too_low) keep_better(best, fixed_fit(values, sizes, weights, 1.0, formal_order));
  }
  return best;
}

/// The half width about the finest value from the fit, its safety factor and its scatter: the last formulas
/// of the paper.
double uncertainty_of(const Fit& fit, double finest, double data_range, double safety_factor) {
  const double misfit = fit.deviation + std::abs(finest - fit.at_finest);
  if (fit.deviation < data_range) return safety_factor * fit.error() + misfit;
  return cautious_safety_factor * fit.deviation / data_range * (fit.error() + misfit);
}

Extrapolation from_four_or_more(const Values& values, const Values& sizes) {
  const double widened = widening * range_of(values);
  const double data_range = range_of(values) / static_cast<double>(values.size() - 1);
  const Observed observed = observe(values, sizes);
  const std::optional<Fit> fit =
      observed.trusted ? observed.trusted : fallback_fit(values, sizes, observed.too_low);
  if (!fit) return finest_of(values, "no series in the size fits the values", observed.order, widened);

  std::string reason = reason_of_order(observed.order);
  const bool converges_badly = is_oscillating(values) || !(observed.order >= lowest_trusted_order);
  if (is_oscillating(values)) {
    reason = "the values oscillate";
  } else if (reason.empty() && !(fit->deviation < data_range)) {
    reason = "the values scatter by " + rounded(fit->deviation) + ", more than their step from one size to " +
             "the next, " + rounded(data_range);
  }
  const double factor = reason.empty() ? trusted_safety_factor : cautious_safety_factor;
  const double uncertainty = uncertainty_of(*fit, values.front(), data_range, factor);
  if (!reason.empty())
    return finest_of(values, reason, observed.order,
                     converges_badly ? std::max(uncertainty, widened) : uncertainty);
  return {.justified = true, .order = observed.order, .value = fit->limit, .uncertainty = uncertainty};
}

}  // namespace

Extrapolation extrapolate(const std::vector<double>& values, const std::vector<double>& sizes) {
  const std::string fault = fault_of(values, sizes);
  if (!fault.empty()) return finest_of(values, fault, not_a_number, infinity);
  if (values.size() == 1) return finest_of(values, "there is one value only", not_a_number, infinity);
  const double round_off = round_off_of(values), range = range_of(values);
  const bool three = values.size() == 3;
  Extrapolation result;
  if (range <= round_off)
    result =
        finest_of(values, "the values are equal, so that no order shows", not_a_number, round_off + range);
  else if (values.size() == 2)
    result = finest_of(values, "there are two values only", not_a_number, widening * range);
  else
    result = three ? from_three(values, sizes) : from_four_or_more(values, sizes);
  if (values.size() > 2) result.method = three ? "Celik et al. 2008" : "Eca & Hoekstra 2014";
  result.uncertainty = std::max(result.uncertainty, round_off);
  return result;
}

}  // namespace launchsafe::math
