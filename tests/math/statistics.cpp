#include "launchsafe/math/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace math = launchsafe::math;

/// Table 8 of the paper: gap in cm, highest temperature at 18 ms in K, safe rows.
const std::vector<double> gaps{0.0, 0.01, 0.02, 0.03, 0.039};
const std::vector<double> temperatures{416.1, 442.2, 467.7, 492.9, 523.3};

TEST(LeastSquares, GiveTheLineOfThePapersSafeRows) {
  const auto fit = math::fit_line(gaps, temperatures);
  ASSERT_TRUE(fit.has_value());
  // Ordinary least squares of Table 8, worked out apart: K and K/cm.
  EXPECT_NEAR(fit->coefficients[0], 414.939, 5.01e-4);
  EXPECT_NEAR(fit->coefficients[1], 2702.061, 5.01e-4);
  EXPECT_EQ(fit->degrees_of_freedom, 3);
  double total = 0.0;
  for (const double residual : fit->residuals) total += residual;
  EXPECT_NEAR(total, 0.0, 1e-10);
}

TEST(LeastSquares, TheDeviationIsTheTextbooksForALine) {
  // x = 0..4, y = 1, 3, 2, 5, 4: slope 0.8, intercept 1.4, residual sum 3.6, s^2 = 1.2, Sxx = 10.
  const auto fit = math::fit_line({0, 1, 2, 3, 4}, {1, 3, 2, 5, 4});
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->coefficients[0], 1.4, 1e-13);
  EXPECT_NEAR(fit->coefficients[1], 0.8, 1e-13);
  EXPECT_NEAR(fit->residual_deviation, std::sqrt(1.2), 1e-13);
}

TEST(LeastSquares, RecoversAPolynomialExactly) {
  std::vector<std::vector<double>> rows;
  std::vector<double> y;
  for (int k = 0; k < 8; ++k) {
    const double x = 0.3 * k - 1.0;
    rows.push_back({1.0, x, x * x, x * x * x});
    y.push_back(2.0 - x + 0.5 * x * x + 4.0 * x * x * x);
  }
  const auto fit = math::least_squares(rows, y);
  ASSERT_TRUE(fit.has_value());
  const double expected[] = {2.0, -1.0, 0.5, 4.0};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(fit->coefficients[k], expected[k], 1e-12);
}

TEST(LeastSquares, UselessDataGiveNoFit) {
  EXPECT_FALSE(math::fit_line({1.0}, {1.0}).has_value());
  EXPECT_FALSE(math::fit_line({2.0, 2.0, 2.0}, {1.0, 2.0, 3.0}).has_value());
  EXPECT_FALSE(math::fit_line({1.0, 2.0, 3.0}, {1.0, 2.0}).has_value());
  EXPECT_FALSE(math::fit_line({1.0, 2.0, std::nan("")}, {1.0, 2.0, 3.0}).has_value());
}

TEST(LeastSquares, WithoutFreedomThereIsNoUncertaintyToState) {
  const auto fit = math::fit_line({0.0, 1.0}, {1.0, 3.0});
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->coefficients[1], 2.0, 1e-14);
  EXPECT_TRUE(std::isnan(fit->residual_deviation));
}

TEST(GridConvergence, FindsTheOrderOfAnExactPowerLaw) {
  const std::array<double, 3> sizes{1.0, 1.5, 3.0};  // unequal ratios
  const auto value = [](double h) { return 7.0 + 0.2 * std::pow(h, 1.7); };
  const auto grid = math::grid_convergence({value(1.0), value(1.5), value(3.0)}, sizes);
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(grid->order, 1.7, 1e-10);
  EXPECT_NEAR(grid->extrapolated, 7.0, 1e-10);
  EXPECT_FALSE(grid->oscillating);
}

TEST(GridConvergence, MeshesWithoutAnOrderGiveNone) {
  EXPECT_FALSE(math::grid_convergence({1.0, 1.0, 2.0}, {1.0, 2.0, 4.0}).has_value());
  EXPECT_FALSE(math::grid_convergence({1.0, 2.0, 3.0}, {1.0, 2.0, 4.0}).has_value());
  EXPECT_FALSE(math::grid_convergence({1.0, 2.0, 4.0}, {4.0, 2.0, 1.0}).has_value());
  EXPECT_FALSE(math::grid_convergence({1.0, 2.0, std::nan("")}, {1.0, 2.0, 4.0}).has_value());
}

}  // namespace
