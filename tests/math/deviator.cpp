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

}  // namespace
