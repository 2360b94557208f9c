#include "launchsafe/math/deviator.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

namespace math = launchsafe::math;
using Deviator = math::Deviator<double>;

Deviator random_deviator(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  return {share(random), share(random), share(random)};
}

TEST(DeviatorVector, KeepsComponentsContractionAndRotation) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 100; ++k) {
    const Deviator a = random_deviator(random), b = random_deviator(random);
    const auto back = deviator_of(vector_of(a));
    EXPECT_NEAR(back.rr, a.rr, 1e-15);
    EXPECT_NEAR(back.xx, a.xx, 1e-15);
    EXPECT_NEAR(back.rx, a.rx, 1e-15);
    EXPECT_NEAR(contract(vector_of(a), vector_of(b)), contract(a, b), 1e-14);
    const auto q = math::rotation_of(0.07 * k);
    const auto turned = deviator_of(rotate_by_twice(vector_of(a), twice(q)));
    const auto expected = rotate(a, q);
    EXPECT_NEAR(turned.rr, expected.rr, 2e-15);
    EXPECT_NEAR(turned.xx, expected.xx, 2e-15);
    EXPECT_NEAR(turned.rx, expected.rx, 2e-15);
  }
}

TEST(Rotation, SmallAndLargeSpinsTurnByTheHalfAngleFormInEveryLane) {
  // Lanes on both sides of the spin below which the series is taken; reference (1 - h^2, 2 h)/(1 + h^2).
  math::Pack spins(0.0);
  const double some[] = {0.0, 1e-9, -1e-5, 1.9e-3, -2.1e-3, 0.1, 1.0, 3.0};
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) spins.set(lane, some[lane]);
  const auto packed = math::rotation_of(spins);
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    const double h = 0.5 * some[lane], cosine = (1.0 - h * h) / (1.0 + h * h), sine = 2.0 * h / (1.0 + h * h);
    EXPECT_NEAR(packed.cosine[lane], cosine, 2e-16) << some[lane];
    EXPECT_NEAR(packed.sine[lane], sine, 2e-16) << some[lane];
    const auto alone = math::rotation_of(some[lane]);
    EXPECT_EQ(packed.cosine[lane], alone.cosine) << some[lane];
    EXPECT_EQ(packed.sine[lane], alone.sine) << some[lane];
  }
}

}  // namespace
