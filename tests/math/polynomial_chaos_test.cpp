#include "launchsafe/math/polynomial_chaos.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace launchsafe::math {
namespace {

using Output = std::function<double(const std::vector<double>&)>;

std::vector<double> values_at(const Output& output, const std::vector<double>& points, std::size_t inputs) {
  std::vector<double> values;
  for (auto row = points.begin(); row != points.end(); row += static_cast<std::ptrdiff_t>(inputs))
    values.push_back(output({row, row + static_cast<std::ptrdiff_t>(inputs)}));
  return values;
}

double normal_at(double u) { return quantile(Distribution::normal(0.0, 1.0), u); }

/// Ishigami's function of inputs between -pi and pi, with a = 7 and b = 0.1: its mean is 3.5, its variance
/// 13.8446, its indices of first order 0.3139, 0.4424, 0, of total order 0.5576, 0.4424, 0.2437 (Ishigami &
/// Homma, ISUMA 1990).
double ishigami(const std::vector<double>& u) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
  return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

TEST(PolynomialChaos, FindsAPolynomialOfUniformAndNormalInputsExactly) {
  const std::vector<ChaosBasis> inputs{ChaosBasis::legendre, ChaosBasis::hermite, ChaosBasis::legendre};
  // 2 + 3 x + 4 z + 5 x z with x uniform from -1 to 1 and z standard normal: variances 3, 16 and 25/3.
  const auto output = [](const std::vector<double>& u) {
    const double x = 2.0 * u[0] - 1.0, z = normal_at(u[1]);
    return 2.0 + 3.0 * x + 4.0 * z + 5.0 * x * z;
  };
  const std::vector<double> points = unit_points(30, 3, 1);
  const std::vector<double> values = values_at(output, points, 3);
  const PolynomialChaos chaos = fit_chaos(inputs, points, values);
  ASSERT_EQ(chaos.reason, "");
  EXPECT_NEAR(chaos.mean(), 2.0, 1e-10);
  EXPECT_NEAR(chaos.variance(), 3.0 + 16.0 + 25.0 / 3.0, 1e-9);
  EXPECT_LT(chaos.leave_one_out, 1e-9);
  const SobolIndices indices = chaos_indices(chaos, points, values, {0, 1, 2, 3});
  const double variance = 82.0 / 3.0;
  EXPECT_NEAR(indices.inputs[0].first.value, 3.0 / variance, 1e-9);
  EXPECT_NEAR(indices.inputs[0].total.value, (3.0 + 25.0 / 3.0) / variance, 1e-9);
  EXPECT_NEAR(indices.inputs[1].first.value, 16.0 / variance, 1e-9);
  EXPECT_NEAR(indices.inputs[2].total.value, 0.0, 1e-9);
  // The first two together have all of it.
  const SobolIndices together = chaos_indices(chaos, points, values, {0, 2, 3});
  EXPECT_NEAR(together.inputs[0].first.value, 1.0, 1e-9);
}

TEST(PolynomialChaos, TellsTheIndicesOfIshigamisFunction) {
  const std::vector<double> points = unit_points(256, 3, 1);
  const std::vector<double> values = values_at(ishigami, points, 3);
  const PolynomialChaos chaos = fit_chaos(std::vector(3, ChaosBasis::legendre), points, values);
  EXPECT_NEAR(chaos.mean(), 3.5, 0.05);
  EXPECT_NEAR(chaos.variance(), 13.8446, 0.4);
  const SobolIndices indices = chaos_indices(chaos, points, values, {0, 1, 2, 3});
  const double first[] = {0.3139, 0.4424, 0.0}, total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(indices.inputs[i].first.value, first[i], 0.02) << i;
    EXPECT_NEAR(indices.inputs[i].total.value, total[i], 0.02) << i;
  }
}

TEST(PolynomialChaos, ItsLeaveOneOutErrorIsThatOfFitsThatLeaveOneOut) {
  // A line through noise: the residual at a point over one less its leverage, known in closed form.
  const std::size_t count = 20;
  const std::vector<double> points = unit_points(count, 1, 3);
  SplitMix64 random(5);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<double>(random.below(1000)) / 1000.0);
  const PolynomialChaos chaos = fit_chaos({ChaosBasis::legendre}, points, values);
  // Nothing can be learnt from noise: the error is at least its spread, 1/sqrt(12) of a uniform.
  EXPECT_GT(chaos.leave_one_out, 0.2);
  EXPECT_LE(chaos.terms.size(), 3u);
}

TEST(PolynomialChaos, LeavesOutWhatHasNoNumberAndRefusesTooFew) {
  const std::vector<ChaosBasis> inputs(2, ChaosBasis::legendre);
  const std::vector<double> points = unit_points(12, 2, 1);
  std::vector<double> values = values_at([](const std::vector<double>& u) { return u[0]; }, points, 2);
  values[3] = std::numeric_limits<double>::quiet_NaN();
  const PolynomialChaos chaos = fit_chaos(inputs, points, values);
  EXPECT_EQ(chaos.reason, "");
  EXPECT_EQ(chaos.points, 11u);
  EXPECT_NEAR(chaos.mean(), 0.5, 1e-10);
  for (std::size_t i = 4; i < 9; ++i) values[i] = std::numeric_limits<double>::infinity();
  const PolynomialChaos few = fit_chaos(inputs, points, values);
  EXPECT_NE(few.reason, "");
  EXPECT_EQ(chaos_indices(few, points, values, {0, 1, 2}).reason, few.reason);
  const std::vector<double> same(12, 7.0);
  EXPECT_FALSE(chaos_indices(fit_chaos(inputs, points, same), points, same, {0, 1, 2}).reason.empty());
}

}  // namespace
}  // namespace launchsafe::math
