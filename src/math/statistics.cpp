#include "launchsafe/math/statistics.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace launchsafe::math {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double student_quantile(double level, int degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.5 * (1.0 + level));
}

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

bool is_fittable(const std::vector<std::vector<double>>& rows, const std::vector<double>& y) {
  if (rows.empty() || rows.size() != y.size() || rows.front().empty() || !all_finite(y)) return false;
  const std::size_t width = rows.front().size();
  return rows.size() >= width && std::ranges::all_of(rows, [&](const std::vector<double>& row) {
           return row.size() == width && all_finite(row);
         });
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// a -= factor b.
void subtract(std::vector<double>& a, double factor, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= factor * b[i];
}

/// X = Q R by Gram-Schmidt, every column orthogonalised twice, which keeps Q orthogonal to round-off.
struct Factors {
  std::vector<std::vector<double>> q;  ///< orthonormal columns
  std::vector<std::vector<double>> r;  ///< r[i][j], upper triangle
};

/// Nothing where a column hardly differs from what the ones before it span.
std::optional<Factors> factorised(const std::vector<std::vector<double>>& rows) {
  const std::size_t width = rows.front().size();
  Factors factors{{}, std::vector<std::vector<double>>(width, std::vector<double>(width, 0.0))};
  for (std::size_t k = 0; k < width; ++k) {
    std::vector<double> column;
    for (const std::vector<double>& row : rows) column.push_back(row[k]);
    const double length = std::sqrt(dot(column, column));
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t i = 0; i < k; ++i) {
        const double part = dot(factors.q[i], column);
        factors.r[i][k] += part;
        subtract(column, part, factors.q[i]);
      }
    }
    const double left = std::sqrt(dot(column, column));
    if (!(left > 1e-13 * length)) return std::nullopt;
    factors.r[k][k] = left;
    for (double& value : column) value /= left;
    factors.q.push_back(std::move(column));
  }
  return factors;
}

/// x with R x = b, R upper triangular.
std::vector<double> back_substituted(const std::vector<std::vector<double>>& r, std::vector<double> b) {
  for (std::size_t k = b.size(); k-- > 0;) {
    b[k] /= r[k][k];
    for (std::size_t i = 0; i < k; ++i) b[i] -= r[i][k] * b[k];
  }
  return b;
}

/// (X^T X)^-1 = R^-1 R^-T, row by row.
std::vector<double> inverse_normal_of(const std::vector<std::vector<double>>& r) {
  const std::size_t width = r.size();
  std::vector<double> inverse(width * width, 0.0);
  for (std::size_t k = 0; k < width; ++k) {
    std::vector<double> unit(width, 0.0);
    unit[k] = 1.0;
    const std::vector<double> column = back_substituted(r, unit);  // of R^-1
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t j = 0; j < width; ++j) inverse[i * width + j] += column[i] * column[j];
    }
  }
  return inverse;
}

/// Share of the variance about the mean that the fit explains; 1 for data without variance.
double explained_share(const std::vector<double>& y, double residual_sum) {
  const double mean = std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size());
  double total = 0.0;
  for (const double value : y) total += (value - mean) * (value - mean);
  return total > 0.0 ? 1.0 - residual_sum / total : 1.0;
}

}  // namespace

double LeastSquares::at(const std::vector<double>& row) const {
  return std::inner_product(coefficients.begin(), coefficients.end(), row.begin(), 0.0);
}

double LeastSquares::leverage(const std::vector<double>& row) const {
  const std::size_t size = coefficients.size();
  double value = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) value += row[i] * inverse_normal[i * size + j] * row[j];
  }
  return value;
}

double LeastSquares::prediction_half_width(const std::vector<double>& row, double level) const {
  if (degrees_of_freedom < 1) return not_a_number;
  return student_quantile(level, degrees_of_freedom) * residual_deviation * std::sqrt(1.0 + leverage(row));
}

std::optional<LeastSquares> least_squares(const std::vector<std::vector<double>>& rows,
                                          const std::vector<double>& y) {
  if (!is_fittable(rows, y)) return std::nullopt;
  const std::optional<Factors> factors = factorised(rows);
  if (!factors) return std::nullopt;
  const std::size_t width = rows.front().size();

  LeastSquares fit;
  std::vector<double> projected, rest = y;
  for (const std::vector<double>& column : factors->q) {
    projected.push_back(dot(column, rest));
    subtract(rest, projected.back(), column);
  }
  fit.coefficients = back_substituted(factors->r, projected);
  for (std::size_t i = 0; i < rows.size(); ++i) fit.residuals.push_back(y[i] - fit.at(rows[i]));
  fit.inverse_normal = inverse_normal_of(factors->r);
  fit.degrees_of_freedom = static_cast<int>(rows.size() - width);
  const double residual_sum = dot(fit.residuals, fit.residuals);
  fit.residual_deviation =
      fit.degrees_of_freedom > 0 ? std::sqrt(residual_sum / fit.degrees_of_freedom) : not_a_number;
  fit.r_squared = explained_share(y, residual_sum);
  for (std::size_t k = 0; k < width; ++k) {
    fit.standard_errors.push_back(fit.residual_deviation * std::sqrt(fit.inverse_normal[k * width + k]));
  }
  return fit;
}

std::vector<double> polynomial_row(double x, int degree) {
  std::vector<double> row{1.0};
  for (int k = 0; k < degree; ++k) row.push_back(row.back() * x);
  return row;
}

std::optional<LeastSquares> fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::vector<double>> rows;
  for (const double value : x) rows.push_back(polynomial_row(value, 1));
  return least_squares(rows, y);
}

double one_sided_tolerance_factor(int n, double coverage, double confidence) {
  if (n < 2 || !(coverage > 0.0 && coverage < 1.0) || !(confidence > 0.0 && confidence < 1.0))
    return not_a_number;
  const double root = std::sqrt(static_cast<double>(n));
  const double shift = boost::math::quantile(boost::math::normal(), coverage) * root;
  return boost::math::quantile(boost::math::non_central_t(n - 1, shift), confidence) / root;
}

double exponential_tolerance_factor(int n, double coverage, double confidence) {
  // Twice the sum of magnitudes over their scale is chi-squared; of the scale, half of 1 - coverage is beyond
  // -ln(2 (1 - coverage)) on one side.
  const boost::math::chi_squared magnitudes(2.0 * n);
  const double largest_scale = 2.0 * n / boost::math::quantile(magnitudes, 1.0 - confidence);
  return -std::log(2.0 * (1.0 - coverage)) * largest_scale;
}

double one_sided_student_factor(int n, double level) {
  if (n < 1 || !(level > 0.0 && level < 1.0)) return not_a_number;
  return boost::math::quantile(boost::math::students_t(n), level);
}

Interval clopper_pearson(std::size_t count, std::size_t trials, double level) {
  const double k = static_cast<double>(count), rest = static_cast<double>(trials - count);
  const double tail = 0.5 * (1.0 - level);
  return {count == 0 ? 0.0 : boost::math::ibeta_inv(k, rest + 1.0, tail),
          count == trials ? 1.0 : boost::math::ibetac_inv(k + 1.0, rest, tail)};
}

namespace {

/// The order p > 0 of the power law through three values, whose (r31^p - 1)/(r21^p - 1) grows with p; NaN
/// where there is none up to 50.
double bracketed_order(const std::array<double, 3>& values, double r21, double r31) {
  const double wanted = (values[2] - values[0]) / (values[1] - values[0]);
  const auto excess = [&](double p) {
    return std::expm1(p * std::log(r31)) / std::expm1(p * std::log(r21)) - wanted;
  };
  constexpr double lowest = 1e-6, highest = 50.0;
  if (!(excess(lowest) < 0.0 && excess(highest) > 0.0)) return not_a_number;
  std::uintmax_t iterations = 100;
  const auto [left, right] = boost::math::tools::toms748_solve(
      excess, lowest, highest, boost::math::tools::eps_tolerance<double>(46), iterations);
  return 0.5 * (left + right);
}

}  // namespace

std::optional<GridConvergence> grid_convergence(const std::array<double, 3>& values,
                                                const std::array<double, 3>& cell_sizes) {
  const double fine_difference = values[1] - values[0], coarse_difference = values[2] - values[1];
  const double r21 = cell_sizes[1] / cell_sizes[0], r32 = cell_sizes[2] / cell_sizes[1];
  const double ratio = coarse_difference / fine_difference;
  if (!(r21 > 1.0) || !(r32 > 1.0) || !std::isfinite(ratio) || ratio == 0.0) return std::nullopt;

  // The order is the fixed point of p = |ln|ratio| + q(p)| / ln r21, q = ln[(r21^p - s)/(r32^p - s)].
  const double sign = ratio > 0.0 ? 1.0 : -1.0;
  double order = std::abs(std::log(std::abs(ratio))) / std::log(r21);
  double change = 1.0;
  for (int iteration = 0; iteration < 200 && std::abs(change) > 1e-13; ++iteration) {
    const double q = std::log((std::pow(r21, order) - sign) / (std::pow(r32, order) - sign));
    const double next = std::abs(std::log(std::abs(ratio)) + q) / std::log(r21);
    change = next - order;
    order = next;
  }
  // Between ratios that differ much the fixed point may not attract; the root is the same.
  if (!(std::abs(change) < 1e-6)) order = bracketed_order(values, r21, r21 * r32);
  if (!(order > 1e-6)) return std::nullopt;

  const double growth = std::pow(r21, order);
  GridConvergence result;
  result.order = order;
  result.extrapolated = (growth * values[0] - values[1]) / (growth - 1.0);
  result.fine_error = std::abs(fine_difference / values[0]);
  result.fine_index = 1.25 * result.fine_error / (growth - 1.0);
  result.oscillating = ratio < 0.0;
  return result;
}

}  // namespace launchsafe::math
