#include "launchsafe/math/sensitivity.hpp"

#include "launchsafe/math/statistics.hpp"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace launchsafe::math {
namespace {
constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();

/// f_A and f_B of all rows.
std::vector<double> sample_outputs(std::size_t blocks, const std::vector<double>& rows) {
  std::vector<double> values;
  for (std::size_t k = 0; k < rows.size(); k += blocks) {
    values.push_back(rows[k + SaltelliDesign::block_a]);
    values.push_back(rows[k + SaltelliDesign::block_b]);
  }
  return values;
}

double largest_size(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// What a row adds to the sums from which the estimates follow: two numbers for the variance, then three for
/// each input.
struct Sums {
  static constexpr std::size_t width(std::size_t inputs) { return 2 + 3 * inputs; }
  static constexpr std::size_t output = 0;  ///< f_A + f_B
  static constexpr std::size_t square = 1;  ///< f_A^2 + f_B^2
  static constexpr std::size_t first(std::size_t input) { return 2 + 3 * input; }
  static constexpr std::size_t difference(std::size_t input) { return 3 + 3 * input; }  ///< f_AB - f_A
  static constexpr std::size_t total(std::size_t input) { return 4 + 3 * input; }       ///< (f_AB - f_A)^2
};

/// The contributions of all rows, one row after the other, for outputs counted from `origin` in units of
/// `unit`.
std::vector<double> contributions_of(const std::vector<double>& rows, std::size_t inputs, double origin,
                                     double unit) {
  std::vector<double> contributions;
  contributions.reserve(rows.size() / (inputs + 2) * Sums::width(inputs));
  for (std::size_t k = 0; k < rows.size(); k += inputs + 2) {
    const double f_a = (rows[k + SaltelliDesign::block_a] - origin) / unit;
    const double f_b = (rows[k + SaltelliDesign::block_b] - origin) / unit;
    contributions.insert(contributions.end(), {f_a + f_b, f_a * f_a + f_b * f_b});
    for (std::size_t i = 0; i < inputs; ++i) {
      const double f_ab = (rows[k + SaltelliDesign::block_ab(i)] - origin) / unit;
      const double difference = f_ab - f_a;
      contributions.insert(contributions.end(), {f_b * difference, difference, difference * difference});
    }
  }
  return contributions;
}

/// The sums over rows that count as often as `counts` says.
std::vector<double> summed(const std::vector<double>& contributions, const std::vector<double>& counts) {
  const std::size_t width = contributions.size() / counts.size();
  std::vector<double> sums(width, 0.0);
  const double* row = contributions.data();  // plain pointers: most of the time goes by here
  double* const sum = sums.data();
  for (const double count : counts) {
    if (count > 0.0) {
      for (std::size_t k = 0; k < width; ++k) sum[k] += count * row[k];
    }
    row += width;
  }
  return sums;
}

/// Variance of f_A and f_B together.
double variance_of(const std::vector<double>& sums, double rows) {
  const double mean = sums[Sums::output] / (2.0 * rows);
  return (sums[Sums::square] - 2.0 * rows * mean * mean) / (2.0 * rows - 1.0);
}

/// First-order indices of all inputs, then total-order ones.
std::vector<double> indices_of(const std::vector<double>& sums, double rows) {
  const std::size_t inputs = (sums.size() - 2) / 3;
  const double mean = sums[Sums::output] / (2.0 * rows), variance = variance_of(sums, rows);
  std::vector<double> indices(2 * inputs);
  for (std::size_t i = 0; i < inputs; ++i) {
    // f_B counts from the mean of the rows at hand, in a resample not the origin: worth a point of coverage
    // with 16 rows.
    indices[i] = (sums[Sums::first(i)] - mean * sums[Sums::difference(i)]) / (rows * variance);
    indices[inputs + i] = sums[Sums::total(i)] / (2.0 * rows * variance);
  }
  return indices;
}

/// Replicates of every index; a resample that caught hardly any of the variance gives none.
std::vector<std::vector<double>> index_replicates(const std::vector<double>& contributions, std::size_t rows,
                                                  double variance, const SobolOptions& options) {
  const double count = static_cast<double>(rows);
  std::vector<std::vector<double>> replicates(2 * (contributions.size() / rows - 2) / 3);
  SplitMix64 random(options.seed);
  for (std::size_t k = 0; k < options.resamples; ++k) {
    const std::vector<double> sums = summed(contributions, resampling_counts(rows, random));
    if (!(variance_of(sums, count) > 1e-12 * variance)) continue;
    const std::vector<double> indices = indices_of(sums, count);
    for (std::size_t i = 0; i < indices.size(); ++i) replicates[i].push_back(indices[i]);
  }
  return replicates;
}

/// Indices of rows that vary.
std::vector<InputIndices> estimated(const std::vector<double>& rows, std::size_t inputs, double origin,
                                    double unit, const SobolOptions& options) {
  const std::size_t size = rows.size() / (inputs + 2);
  const double count = static_cast<double>(size);
  const auto contributions = contributions_of(rows, inputs, origin, unit);
  const auto sums = summed(contributions, std::vector<double>(size, 1.0));
  const auto indices = indices_of(sums, count);
  const auto replicates = index_replicates(contributions, size, variance_of(sums, count), options);
  const auto estimate = [&](std::size_t k) {
    return with_interval(indices[k], replicates[k], size, options.level);
  };
  std::vector<InputIndices> result;
  for (std::size_t i = 0; i < inputs; ++i) result.push_back({estimate(i), estimate(inputs + i)});
  return result;
}

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

std::vector<double> SaltelliDesign::point(std::size_t evaluation) const {
  assert(evaluation < evaluations());
  const std::size_t block = evaluation % blocks(), row = evaluation / blocks(), columns = begins.back();
  std::vector<double> values = point_of_row(block == block_b ? b : a, row, columns);
  if (block > block_b)
    for (std::size_t i = begins[block - 2]; i < begins[block - 1]; ++i) values[i] = b[row * columns + i];
  return values;
}

SaltelliDesign saltelli_design(Design design, std::size_t rows, const std::vector<std::size_t>& columns,
                               std::uint64_t seed) {
  SaltelliDesign result{rows, columns.size(), {0}, {}, {}};
  for (const std::size_t count : columns) result.begins.push_back(result.begins.back() + count);
  const std::vector<double> points = unit_points(design, rows, 2 * result.begins.back(), seed);
  for (std::size_t k = 0; k < points.size(); ++k) (k % 2 == 0 ? result.a : result.b).push_back(points[k]);
  return result;
}

SobolIndices sobol_indices(std::size_t inputs, const std::vector<double>& outputs,
                           const SobolOptions& options) {
  const std::size_t blocks = inputs + 2;
  assert(outputs.size() % blocks == 0);
  const std::vector<double> sample = sample_outputs(blocks, outputs);
  const auto [mean, squares] = moments_of(sample);
  SobolIndices result;
  result.mean = mean;
  result.variance = sample.empty() ? not_a_number : squares / static_cast<double>(sample.size() - 1);
  result.inputs.assign(inputs, {no_estimate, no_estimate});

  constexpr std::size_t needed = 16;
  const std::size_t rows = outputs.size() / blocks;
  const auto [least, greatest] = std::minmax_element(sample.begin(), sample.end());
  if (!std::ranges::all_of(outputs, [](double value) { return std::isfinite(value); })) {
    result.reason = "an evaluation has no number";
  } else if (rows < needed) {
    result.reason = std::to_string(rows) + " rows; at least " + std::to_string(needed) + " are needed";
  } else if (!(*greatest - *least > rounding * largest_size(outputs))) {
    result.reason = "the output does not vary";
  } else {
    result.inputs = estimated(outputs, inputs, mean, *greatest - *least, options);
  }
  return result;
}

}  // namespace launchsafe::math
