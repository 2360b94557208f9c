#include "launchsafe/math/phi.hpp"

#include "launchsafe/math/deviator.hpp"

#include <gtest/gtest.h>

namespace {

namespace math = launchsafe::math;

/// phi_k by its Taylor series in extended precision, good for moderate z.
long double series(int k, long double z) {
  long double term = 1.0L, total = 0.0L;
  for (int n = 1; n <= k; ++n) term /= n;
  for (int n = 0; n < 200; ++n) {
    total += term;
    term *= z / (n + k + 1);
  }
  return total;
}

TEST(PhiFunctions, AgreeWithTheirSeries) {
  for (const double z : {-6.0, -2.001, -1.999, -0.5, -0.004, -0.0039, -1e-3, -1e-12, 0.0, 1e-12, 1e-3, 0.5,
                         1.999, 2.001, 12.0}) {
    const auto phi = math::phi_functions(z);
    for (std::size_t k = 0; k < phi.size(); ++k) {
      const double expected = static_cast<double>(series(static_cast<int>(k), z));
      EXPECT_NEAR(phi[k] / expected, 1.0, 2e-14) << "k = " << k << ", z = " << z;
    }
  }
}

TEST(PhiFunctions, AreTheSameDoublesByFewTermsWhereThoseAreEnough) {
  for (int step = -1000; step <= 1000; ++step) {
    const double z = 0.000999 * math::detail::small * step;
    EXPECT_EQ(math::detail::phi_by_series<6>(z), math::detail::phi_by_series<22>(z)) << z;
  }
}

TEST(PhiFunctions, DecayForVeryStiffArguments) {
  const auto phi = math::phi_functions(-1e8);
  EXPECT_EQ(phi[0], 0.0);
  EXPECT_NEAR(phi[1], 1e-8, 1e-22);
  EXPECT_NEAR(phi[2], 1e-8, 2e-16);
}

TEST(Rotation, PreservesTheInvariantsOfADeviator) {
  const math::Deviator<double> s{3.0, -1.0, 2.0};
  const auto q = math::rotation_of(0.7);
  EXPECT_NEAR(q.cosine * q.cosine + q.sine * q.sine, 1.0, 1e-15);
  const auto turned = math::rotate(s, q);
  EXPECT_NEAR(math::von_mises(turned), math::von_mises(s), 1e-14);
  EXPECT_NEAR(turned.tt(), s.tt(), 1e-14);  // the hoop direction stays
}

TEST(Rotation, FollowsTheJaumannRate) {
  // dS/dt = W S - S W with W_rx = w: dS_rr = 2 w S_rx, dS_rx = w (S_xx - S_rr).
  const math::Deviator<double> s{3.0, -1.0, 2.0};
  const double w = 1e-6;
  const auto turned = math::rotate(s, math::rotation_of(w));
  EXPECT_NEAR((turned.rr - s.rr) / w, 2.0 * s.rx, 1e-4);
  EXPECT_NEAR((turned.rx - s.rx) / w, s.xx - s.rr, 1e-4);
}

TEST(Deviator, EquivalentsAreThoseOfUniaxialStates) {
  EXPECT_NEAR(math::von_mises(math::Deviator<double>{-1.0 / 3.0, 2.0 / 3.0, 0.0}), 1.0, 1e-15);
  EXPECT_NEAR(math::equivalent_strain(math::Deviator<double>{-0.5, 1.0, 0.0}), 1.0, 1e-15);
}

}  // namespace
