#include "launchsafe/math/sampling.hpp"

#include <gtest/gtest.h>

namespace {

namespace math = launchsafe::math;
using math::Distribution;

// Of a quasi-random sequence the moments of 4096 draws are within 0.01.
TEST(CopulaDraws, ScoresHaveTheCorrelationAndSharesStayUniform) {
  const std::vector<double> correlation{1, 0.6, -0.3, 0.6, 1, 0.2, -0.3, 0.2, 1};
  const math::CopulaDraws draws(correlation, {{}, {}, {}});
  const std::size_t count = 4096;
  const std::vector<double> points = math::unit_points(math::Design::scrambled_sobol, count, 3, 1);
  std::vector<double> products(9), shares(3), squares(3);
  for (std::size_t row = 0; row < count; ++row) {
    const std::vector<double> draw = draws.at(math::point_of_row(points, row, 3));
    for (std::size_t i = 0; i < 3; ++i) {
      const double score = math::quantile(Distribution::normal(0, 1), draw[i]);
      shares[i] += draw[i] / count;
      squares[i] += draw[i] * draw[i] / count;
      for (std::size_t j = 0; j < 3; ++j)
        products[3 * i + j] += score * math::quantile(Distribution::normal(0, 1), draw[j]) / count;
    }
  }
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(products[i], correlation[i], 0.01) << i;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(shares[i], 1.0 / 2.0, 0.003) << i;
    EXPECT_NEAR(squares[i], 1.0 / 3.0, 0.003) << i;
  }
}

// Beside a score z the other is normal about 0.6 z, with a variance of 1 - 0.36. The first is drawn after it.
TEST(CopulaDraws, BesideAFixedShareTheOthersAreDrawnAsTheyAreThere) {
  const auto normal = Distribution::normal(0, 1);
  const math::CopulaDraws draws({1, 0.6, 0.6, 1}, {{}, math::cumulative(normal, 1.5)});
  for (const double z : {-1.0, 0.0, 2.0}) {
    const std::vector<double> draw = draws.at({math::cumulative(normal, z), 0.3});
    EXPECT_NEAR(math::quantile(normal, draw[0]), 0.6 * 1.5 + 0.8 * z, 1e-12);
    EXPECT_EQ(draw[1], math::cumulative(normal, 1.5));
  }
  const std::vector<double> at_end = math::CopulaDraws({1, 0.6, 0.6, 1}, {{}, 1.0}).at({0.5, 0.5});
  EXPECT_GT(at_end[0], 0.999);
  EXPECT_LT(at_end[0], 1.0);
}

TEST(CopulaDraws, WithoutCorrelationPointsStayAsTheyAre) {
  EXPECT_EQ(math::CopulaDraws({}, {{}, 0.25, {}}).at({0.1, 0.2, 0.0}), (std::vector<double>{0.1, 0.25, 0.0}));
}

}  // namespace
