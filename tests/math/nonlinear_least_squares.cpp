#include "launchsafe/math/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace launchsafe::math {
namespace {

using Points = std::vector<std::vector<double>>;

/// Misra1a of NIST's Statistical Reference Datasets: y = b1 (1 - exp(-b2 x)), here of the logarithms of b1
/// and b2.
std::optional<Points> misra(const Points& points) {
  const double x[] = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                      378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
  const double y[] = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                      44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
  Points all;
  for (const std::vector<double>& point : points) {
    std::vector<double>& residuals = all.emplace_back();
    for (std::size_t i = 0; i < std::size(x); ++i)
      residuals.push_back(std::exp(point[0]) * -std::expm1(-std::exp(point[1]) * x[i]) - y[i]);
  }
  return all;
}

// Certified: b1 = 238.94212918, b2 = 5.5015643181e-4, standard deviations 2.7070075241 and 7.2668688436e-6,
// sum of squares 0.12455138894. NIST's own starting values.
TEST(NonlinearFit, MeetsTheCertifiedValuesOfMisra1a) {
  const NonlinearFit fit = fit_nonlinear(misra, {std::log(250.0), std::log(5e-4)}, 1e-7);
  ASSERT_EQ(fit.failure, FitFailure::none);
  EXPECT_NEAR(std::exp(fit.unknowns[0]), 238.94212918, 1e-3 * 2.7);
  EXPECT_NEAR(std::exp(fit.unknowns[1]), 5.5015643181e-4, 1e-3 * 7.3e-6);
  EXPECT_NEAR(fit.sum_of_squares(), 0.12455138894, 1e-7);
  const double variance = fit.sum_of_squares() / 12.0;  // 14 points less 2 unknowns
  EXPECT_NEAR(std::sqrt(variance * fit.covariance[0]), 2.7070075241 / 238.94212918, 1e-5);
  EXPECT_NEAR(std::sqrt(variance * fit.covariance[3]), 7.2668688436e-6 / 5.5015643181e-4, 1e-5);
}

TEST(NonlinearFit, AsksForAllPointsOfAJacobianAtOnce) {
  std::size_t most = 0;
  const auto counted = [&most](const Points& points) {
    most = std::max(most, points.size());
    return misra(points);
  };
  fit_nonlinear(counted, {std::log(250.0), std::log(5e-4)}, 1e-6);
  EXPECT_EQ(most, 3u);  // the point itself, and one for each unknown
}

/// Residuals that are the sums of a point's numbers with these factors, less 1.
ResidualsAtPoints sums(const Points& factors) {
  return [factors](const Points& points) {
    Points all;
    for (const std::vector<double>& point : points) {
      std::vector<double>& residuals = all.emplace_back();
      for (const std::vector<double>& row : factors) {
        residuals.push_back(-1.0);
        for (std::size_t k = 0; k < row.size(); ++k) residuals.back() += row[k] * point[k];
      }
    }
    return std::optional(all);
  };
}

TEST(NonlinearFit, SaysWhatIsWrong) {
  using enum FitFailure;
  EXPECT_EQ(fit_nonlinear(sums({{1.0, 2.0}}), {0.0, 0.0}, 1e-6).failure, too_few_residuals);
  const Points dependent{{1.0, 2.0}, {2.0, 4.0}, {3.0, 6.0}}, without{{1.0, 0.0}, {2.0, 0.0}};
  EXPECT_EQ(fit_nonlinear(sums(dependent), {0.0, 0.0}, 1e-6).failure, singular);
  EXPECT_EQ(fit_nonlinear(sums(without), {0.0, 0.0}, 1e-6).failure, singular);
  const auto none_there = [](const Points&) { return std::optional<Points>{}; };
  EXPECT_EQ(fit_nonlinear(none_there, {0.0}, 1e-6).failure, not_computable);
  const auto infinite = [](const Points& points) {
    return std::optional(Points(points.size(), {std::nan(""), 1.0}));
  };
  EXPECT_EQ(fit_nonlinear(infinite, {0.0}, 1e-6).failure, not_computable);
}

}  // namespace
}  // namespace launchsafe::math
