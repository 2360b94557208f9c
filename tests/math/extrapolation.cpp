#include "launchsafe/math/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK
#include <rapidcheck/gtest.h>
#endif

namespace {

namespace math = launchsafe::math;
using Values = std::vector<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// phi0 + factor h^order.
Values power_law(const Values& sizes, double limit, double factor, double order) {
  Values values;
  for (const double size : sizes) values.push_back(limit + factor * std::pow(size, order));
  return values;
}

/// `count` sizes from `finest` on, each `ratio` times the one before.
Values geometric(double finest, double ratio, int count) {
  Values sizes{finest};
  while (static_cast<int>(sizes.size()) < count) sizes.push_back(sizes.back() * ratio);
  return sizes;
}

/// The limit lies within the half width, about the finest value and about the extrapolated one.
bool holds(const math::Extrapolation& found, double finest, double limit) {
  return std::abs(finest - limit) <= found.uncertainty && std::abs(found.value - limit) <= found.uncertainty;
}

TEST(Extrapolation, ThreeValuesGiveThePublishedGridConvergenceIndex) {
  // Celik et al. 2008, table 1, as on the model page, section 10; cells of a 2-D domain of size 1.
  const Values sizes{1.0 / std::sqrt(18000.0), 1.0 / std::sqrt(8000.0), 1.0 / std::sqrt(4500.0)};
  const auto found = math::extrapolate({6.063, 5.972, 5.863}, sizes);
  EXPECT_TRUE(found.justified) << found.reason;
  EXPECT_EQ(found.reason, "");
  EXPECT_EQ(found.method, "Celik et al. 2008");
  EXPECT_NEAR(found.order, 1.5340, 5e-5);
  EXPECT_NEAR(found.value, 6.1685, 5e-5);
  EXPECT_NEAR(found.uncertainty / 6.063, 0.02175, 5e-6);
}

TEST(Extrapolation, RecoversOrderAndLimitOfAPowerLaw) {
  for (const double order : {0.7, 1.0, 1.5, 2.0}) {
    for (const int count : {3, 4, 5, 8}) {
      const Values sizes = geometric(0.05, 1.4, count);
      const auto found = math::extrapolate(power_law(sizes, 420.0, -30.0, order), sizes);
      ASSERT_TRUE(found.justified) << found.reason;
      EXPECT_EQ(found.method, count == 3 ? "Celik et al. 2008" : "Eca & Hoekstra 2014");
      EXPECT_NEAR(found.order, order, 1e-8);
      EXPECT_NEAR(found.value, 420.0, 1e-7);
      // Both methods then are 1.25 times the error of the finest value.
      EXPECT_NEAR(found.uncertainty, 1.25 * 30.0 * std::pow(0.05, order), 1e-6);
    }
  }
}

// The numbers of the next tests come from a second program of the same reading of the formulas (normal
// equations in plain elimination, the order by nested search).

TEST(Extrapolation, NoisyValuesAreFittedByThePowerLaw) {
  const auto found = math::extrapolate({5.012, 5.027, 5.031, 5.068, 5.101}, {1.0, 1.5, 2.0, 3.0, 4.0});
  ASSERT_TRUE(found.justified) << found.reason;
  EXPECT_NEAR(found.order, 1.5282139, 1e-6);  // weighted: its deviation 0.0045653 is the smaller one
  EXPECT_NEAR(found.value, 5.0006708, 1e-6);
  EXPECT_NEAR(found.uncertainty, 0.0205354, 1e-6);
}

TEST(Extrapolation, AnOrderJustAboveTheFormalOneIsTakenForIt) {
  const auto found = math::extrapolate({10.11, 10.22, 10.41, 10.89, 11.62}, {1.0, 1.5, 2.0, 3.0, 4.0});
  ASSERT_TRUE(found.justified) << found.reason;
  EXPECT_NEAR(found.order, 2.0778172, 1e-6);
  EXPECT_NEAR(found.value, 10.003582, 1e-6);  // of phi0 + alpha h^2, weighted
  EXPECT_NEAR(found.uncertainty, 0.1433074, 1e-6);
}

TEST(Extrapolation, AnOrderFarAboveTheFormalOneGetsTheFactorThree) {
  const auto found = math::extrapolate({4.02, 4.05, 4.2, 5.6, 9.1}, {1.0, 1.5, 2.0, 4.0, 6.0});
  EXPECT_FALSE(found.justified);
  EXPECT_NEAR(found.order, 2.8315488, 1e-6);
  EXPECT_DOUBLE_EQ(found.value, 4.02);
  EXPECT_NEAR(found.uncertainty, 0.768304, 1e-6);  // of phi0 + alpha h^2, weighted
}

TEST(Extrapolation, ScatterBeyondTheDataRangeGetsTheFactorThree) {
  const auto found = math::extrapolate({1.00, 1.19, 1.05, 1.08, 1.27, 1.19}, {1.0, 1.2, 1.5, 2.0, 2.5, 3.0});
  EXPECT_FALSE(found.justified);
  EXPECT_NEAR(found.order, 0.621928, 1e-6);
  EXPECT_DOUBLE_EQ(found.value, 1.0);
  EXPECT_NEAR(found.uncertainty, 1.8599802, 1e-5);  // 3 sigma/Delta (error + sigma + misfit)
}

TEST(Extrapolation, OscillatingValuesAreNotExtrapolated) {
  const Values values{2.0, 2.6, 2.3, 2.9, 2.45, 3.0};
  const auto found = math::extrapolate(values, {1.0, 1.2, 1.5, 2.0, 2.5, 3.0});
  EXPECT_FALSE(found.justified);
  EXPECT_DOUBLE_EQ(found.value, 2.0);
  EXPECT_NEAR(found.uncertainty, 3.9423358, 1e-6);  // of phi0 + alpha h; more than 3 (3.0 - 2.0)
  const auto three = math::extrapolate({10.0, 11.0, 9.5}, {1.0, 2.0, 4.0});
  EXPECT_FALSE(three.justified);
  EXPECT_DOUBLE_EQ(three.value, 10.0);
  EXPECT_DOUBLE_EQ(three.uncertainty, 4.5);  // 3 (11 - 9.5)
}

TEST(Extrapolation, DivergingValuesAreNotExtrapolated) {
  // The differences grow as the size falls.
  const auto many = math::extrapolate({1.0, 1.9, 2.6, 3.0, 3.3}, {1.0, 2.0, 4.0, 8.0, 16.0});
  EXPECT_FALSE(many.justified);
  EXPECT_NEAR(many.order, -0.5170481, 1e-6);
  EXPECT_DOUBLE_EQ(many.value, 1.0);
  EXPECT_DOUBLE_EQ(many.uncertainty, 3.0 * (3.3 - 1.0));
  // Celik's formula alone would find order 1 here.
  const auto three = math::extrapolate({1.0, 2.0, 2.5}, {1.0, 2.0, 4.0});
  EXPECT_FALSE(three.justified);
  EXPECT_DOUBLE_EQ(three.uncertainty, 4.5);
}

TEST(Extrapolation, TooLowAnOrderIsNotExtrapolated) {
  for (const int count : {3, 4, 6}) {
    const Values sizes = geometric(1.0, 2.0, count);
    const Values values = power_law(sizes, 1.0, 2.0, 0.1);
    const auto found = math::extrapolate(values, sizes);
    EXPECT_FALSE(found.justified);
    EXPECT_NEAR(found.order, 0.1, 1e-6);
    EXPECT_DOUBLE_EQ(found.value, 3.0);
    EXPECT_GE(found.uncertainty, 3.0 * (values.back() - values.front()));
  }
}

TEST(Extrapolation, EqualValuesLeaveRoundOff) {
  for (const int count : {2, 3, 5}) {
    const auto found =
        math::extrapolate(Values(static_cast<std::size_t>(count), 300.0), geometric(1.0, 2.0, count));
    EXPECT_FALSE(found.justified);
    EXPECT_TRUE(std::isnan(found.order));
    EXPECT_DOUBLE_EQ(found.value, 300.0);
    EXPECT_GT(found.uncertainty, 0.0);
    EXPECT_LT(found.uncertainty, 1e-12);
  }
  EXPECT_GT(math::extrapolate({0.0, 0.0, 0.0, 0.0}, {1.0, 2.0, 3.0, 4.0}).uncertainty, 0.0);
}

TEST(Extrapolation, FewValuesAreNotExtrapolated) {
  const auto two = math::extrapolate({5.0, 5.5}, {1.0, 2.0});
  EXPECT_FALSE(two.justified);
  EXPECT_DOUBLE_EQ(two.value, 5.0);
  EXPECT_DOUBLE_EQ(two.uncertainty, 1.5);
  const auto one = math::extrapolate({5.0}, {1.0});
  EXPECT_FALSE(one.justified);
  EXPECT_DOUBLE_EQ(one.value, 5.0);
  EXPECT_EQ(one.uncertainty, infinity);
}

TEST(Extrapolation, WhatIsNoNumberIsSaidAndNeverBecomesOne) {
  const double nan = std::nan("");
  for (const double bad : {nan, infinity, -infinity}) {
    for (std::size_t place = 0; place < 4; ++place) {
      Values values{1.0, 1.1, 1.3, 1.7};
      values[place] = bad;
      for (const std::size_t count : {std::size_t{3}, std::size_t{4}}) {
        if (place >= count) continue;
        const auto found =
            math::extrapolate(Values(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count)),
                              geometric(1.0, 2.0, static_cast<int>(count)));
        EXPECT_FALSE(found.justified);
        EXPECT_EQ(found.uncertainty, infinity);
      }
    }
  }
}

TEST(Extrapolation, SizesThatAreNoneAreSaid) {
  const std::vector<Values> bad_sizes{{1.0, 1.0, 2.0},     {2.0, 1.0, 0.5}, {0.0, 1.0, 2.0},
                                      {-1.0, 1.0, 2.0},    {1.0, 2.0},      {1.0, std::nan(""), 2.0},
                                      {1.0, 2.0, infinity}};
  for (const Values& sizes : bad_sizes) {
    const auto found = math::extrapolate({1.0, 1.1, 1.3}, sizes);
    EXPECT_FALSE(found.justified);
    EXPECT_EQ(found.uncertainty, infinity);
  }
  EXPECT_EQ(math::extrapolate({}, {}).uncertainty, infinity);
}

/// Share of made series of 4 to 6 sizes whose limit the half width holds; noise in errors of the finest
/// value.
double share_held(double noise) {
  std::mt19937_64 generator(20140115);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  int held = 0;
  constexpr int trials = 600;
  for (int trial = 0; trial < trials; ++trial) {
    const Values sizes = geometric(1.0, 1.2 + 0.8 * uniform(generator), 4 + trial % 3);
    Values values = power_law(sizes, 300.0, 2.0, 0.8 + 1.2 * uniform(generator));
    for (double& value : values) value += 2.0 * noise * normal(generator);
    held += std::abs(values.front() - 300.0) <= math::extrapolate(values, sizes).uncertainty ? 1 : 0;
  }
  return static_cast<double>(held) / trials;
}

TEST(Extrapolation, HalfWidthHoldsTheLimitOfNoisySeriesNineteenTimesInTwenty) {
  EXPECT_GE(share_held(0.0), 1.0);
  EXPECT_GE(share_held(0.02), 0.95);  // what the header promises
}

/// Power laws over the orders that a second-order method shows.
TEST(Extrapolation, HalfWidthHoldsTheLimitOfAnyPowerLaw) {
  for (double order = 0.7; order < 2.505; order += 0.05) {
    for (const double ratio : {1.1, 1.25, 1.5, 2.0, 3.0}) {
      for (const int count : {3, 4, 5, 7}) {
        const Values sizes = geometric(0.02, ratio, count);
        const Values values = power_law(sizes, -4.0, 3.0, order);
        EXPECT_TRUE(holds(math::extrapolate(values, sizes), values.front(), -4.0))
            << "order " << order << ", ratio " << ratio << ", " << count << " values";
      }
    }
  }
}

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK

RC_GTEST_PROP(ExtrapolationProperty, AnyNumbersGiveAHalfWidthAboveZeroAndAReasonOrAnOrder, ()) {
  const auto raw = *rc::gen::nonEmpty<std::vector<int>>(rc::gen::arbitrary<std::vector<int>>());
  Values values;
  for (const int value : raw) values.push_back(value / 16.0);
  if (values.size() > 12) values.resize(12);
  const auto found = math::extrapolate(values, geometric(1.0, 1.3, static_cast<int>(values.size())));
  RC_ASSERT(found.uncertainty > 0.0);
  RC_ASSERT(std::isfinite(found.value));
  RC_ASSERT(found.justified == found.reason.empty());
  RC_ASSERT(!found.justified || (found.order >= 0.5 && found.order < 2.1));
}

#endif

}  // namespace
