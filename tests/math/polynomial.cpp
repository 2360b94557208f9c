#include "launchsafe/math/polynomial.hpp"

#include "launchsafe/math/pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

namespace math = launchsafe::math;

TEST(Polynomial, IsTheSumOfItsPowers) {
  const std::array<double, 4> c{1.0, -2.0, 0.5, 3.0};
  EXPECT_DOUBLE_EQ(math::polynomial(c, 2.0), 1.0 - 4.0 + 2.0 + 24.0);
  const auto packed = math::polynomial(c, math::Pack(2.0));
  for (std::size_t lane = 0; lane < math::pack_width; ++lane)
    EXPECT_EQ(packed[lane], math::polynomial(c, 2.0));
}

TEST(ChebyshevFit, OfAPolynomialIsThatPolynomial) {
  const auto cubic = [](long double x) { return 4.0L - x + 0.25L * x * x - 7.0L * x * x * x; };
  const auto c = math::chebyshev_fit<6>(cubic, -0.3, 0.7);
  const double expected[] = {4.0, -1.0, 0.25, -7.0, 0.0, 0.0};
  for (std::size_t k = 0; k < c.size(); ++k) EXPECT_NEAR(c[k], expected[k], 1e-15) << k;
}

TEST(ChebyshevFit, ErrsLikeTheFirstTermLeftOut) {
  // On [-1, 1] that of e^x from T_n on is 2 I_n(1), about 1/(2^(n-1) n!); twice that for aliasing.
  const auto c = math::chebyshev_fit<8>([](long double x) { return std::exp(x); }, -1.0, 1.0);
  double worst = 0.0;
  for (int k = -100; k <= 100; ++k)
    worst = std::max(worst, std::abs(math::polynomial(c, k / 100.0) - std::exp(k / 100.0)));
  const double left_out = 1.0 / (128.0 * 40320.0);
  EXPECT_LT(worst, 2.0 * left_out);
  EXPECT_GT(worst, 0.5 * left_out);
}

}  // namespace
