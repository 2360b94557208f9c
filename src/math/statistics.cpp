#include "launchsafe/math/statistics.hpp"

#include <Eigen/Dense>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace launchsafe::math {

namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

bool is_fittable(const std::vector<std::vector<double>>& rows, const std::vector<double>& y) {
  if (rows.empty() || rows.size() != y.size() || rows.front().empty() || !all_finite(y)) return false;
  const std::size_t width = rows.front().size();
  return rows.size() >= width && std::ranges::all_of(rows, [&](const std::vector<double>& row) {
           return row.size() == width && all_finite(row);
         });
}

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

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

Moments moments_of(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, squares};
}

double LeastSquares::at(const std::vector<double>& row) const {
  return std::inner_product(coefficients.begin(), coefficients.end(), row.begin(), 0.0);
}

std::optional<LeastSquares> least_squares(const std::vector<std::vector<double>>& rows,
                                          const std::vector<double>& y) {
  if (!is_fittable(rows, y)) return std::nullopt;
  const auto height = static_cast<Index>(rows.size()), width = static_cast<Index>(rows.front().size());
  MatrixXd x(height, width);
  for (Index i = 0; i < height; ++i)
    x.row(i) = VectorXd::Map(rows[static_cast<std::size_t>(i)].data(), width);
  const Eigen::HouseholderQR<MatrixXd> factors(x);
  const auto r = factors.matrixQR().topRows(width).triangularView<Eigen::Upper>();
  // A column that hardly differs from what the ones before it span.
  for (Index k = 0; k < width; ++k)
    if (!(std::abs(factors.matrixQR()(k, k)) > 1e-13 * x.col(k).norm())) return std::nullopt;
  const auto values = VectorXd::Map(y.data(), height);
  const VectorXd coefficients = factors.solve(values), residuals = values - x * coefficients;
  const MatrixXd root = r.solve(MatrixXd::Identity(width, width)), inverse = root * root.transpose();

  LeastSquares fit;
  fit.coefficients.assign(coefficients.begin(), coefficients.end());
  fit.residuals.assign(residuals.begin(), residuals.end());
  fit.inverse_normal.assign(inverse.data(), inverse.data() + inverse.size());
  fit.degrees_of_freedom = static_cast<int>(height - width);
  const double residual_sum = residuals.squaredNorm();
  fit.residual_deviation =
      fit.degrees_of_freedom > 0 ? std::sqrt(residual_sum / fit.degrees_of_freedom) : not_a_number;
  return fit;
}

std::optional<LeastSquares> fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::vector<double>> rows;
  for (const double value : x) rows.push_back({1.0, value});
  return least_squares(rows, y);
}

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
  return GridConvergence{order, (growth * values[0] - values[1]) / (growth - 1.0), ratio < 0.0};
}

}  // namespace launchsafe::math
