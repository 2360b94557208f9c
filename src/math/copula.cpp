#include "launchsafe/math/sampling.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <numeric>

namespace launchsafe::math {

double smallest_eigenvalue(const std::vector<double>& matrix, std::size_t rows) {
  const auto size = static_cast<Eigen::Index>(rows);
  const Eigen::Map<const Eigen::MatrixXd> symmetric(matrix.data(), size, size);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

CopulaDraws::CopulaDraws(const std::vector<double>& correlation, std::vector<std::optional<double>> fixed)
    : fixed_(std::move(fixed)) {
  if (correlation.empty()) return;
  const std::size_t size = fixed_.size();
  assert(correlation.size() == size * size);
  order_.resize(size);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::stable_partition(order_, [this](std::size_t i) { return fixed_[i].has_value(); });
  std::vector<double> ordered;
  for (const std::size_t i : order_)
    for (const std::size_t j : order_) ordered.push_back(correlation[i * size + j]);
  factor_ = covariance_factor(ordered, size).value();
}

std::vector<double> CopulaDraws::at(std::vector<double> point) const {
  constexpr double end = 1e-15;  // no score is infinite
  static const Distribution standard_normal = Distribution::normal(0.0, 1.0);
  for (std::size_t i = 0; i < point.size(); ++i) point[i] = fixed_[i].value_or(point[i]);
  std::vector<double> independent;
  for (std::size_t row = 0; row < order_.size(); ++row) {
    double& share = point[order_[row]];
    const double own = quantile(standard_normal, std::clamp(share, end, 1.0 - end));
    const double* factor = &factor_[row * order_.size()];
    const double of_others = std::inner_product(independent.begin(), independent.end(), factor, 0.0);
    const bool is_fixed = fixed_[order_[row]].has_value();
    independent.push_back(is_fixed ? (own - of_others) / factor[row] : own);
    if (!is_fixed)
      share = std::clamp(cumulative(standard_normal, of_others + factor[row] * own), end, 1.0 - end);
  }
  return point;
}

}  // namespace launchsafe::math
