// Pack against the C++ library, which is correct to about 1 ulp.
#include "launchsafe/math/pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

using launchsafe::math::Pack;
namespace math = launchsafe::math;

constexpr double pack_infinity = std::numeric_limits<double>::infinity();

/// Distance in units in the last place of the expected value.
double ulps(double computed, double expected) {
  const double place = std::nextafter(std::abs(expected), pack_infinity) - std::abs(expected);
  return std::abs(computed - expected) / place;
}

Pack uniform_lanes(std::mt19937_64& random, double from, double to) {
  Pack pack(0.0);
  std::uniform_real_distribution<double> uniform(from, to);
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) pack.set(lane, uniform(random));
  return pack;
}

template <class Function, class Reference>
double worst_ulps(double from, double to, Function function, Reference reference) {
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (int trial = 0; trial < 40000; ++trial) {
    const Pack x = uniform_lanes(random, from, to);
    const Pack y = function(x);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      worst =
          std::max(worst, ulps(y[lane], static_cast<double>(reference(static_cast<long double>(x[lane])))));
    }
  }
  return worst;
}

TEST(PackExp, AgreesWithTheLibraryToTwoUlp) {
  const auto expl = [](long double x) { return std::exp(x); };
  const auto packed = [](Pack x) { return math::exp(x); };
  EXPECT_LE(worst_ulps(-708.0, 709.0, packed, expl), 2.0);
  EXPECT_LE(worst_ulps(-1.0, 1.0, packed, expl), 2.0);
  EXPECT_LE(worst_ulps(-1e-6, 1e-6, packed, expl), 2.0);
}

TEST(PackExp, EndsAreZeroInfinityAndNotANumber) {
  EXPECT_EQ(math::exp(Pack(-1000.0))[0], 0.0);
  EXPECT_EQ(math::exp(Pack(-pack_infinity))[0], 0.0);
  EXPECT_EQ(math::exp(Pack(1000.0))[0], pack_infinity);
  EXPECT_EQ(math::exp(Pack(pack_infinity))[0], pack_infinity);
  EXPECT_EQ(math::exp(Pack(0.0))[1], 1.0);
  EXPECT_TRUE(std::isnan(math::exp(Pack(std::nan("")))[math::pack_width - 1]));
}

TEST(PackLog, AgreesWithTheLibraryToTwoUlp) {
  const auto logl = [](long double x) { return std::log(x); };
  const auto packed = [](Pack x) { return math::log(x); };
  EXPECT_LE(worst_ulps(1e-300, 1e-290, packed, logl), 2.0);
  EXPECT_LE(worst_ulps(0.5, 2.0, packed, logl), 2.0);
  EXPECT_LE(worst_ulps(0.999999, 1.000001, packed, logl), 2.0);
  EXPECT_LE(worst_ulps(1.0, 1e10, packed, logl), 2.0);
  EXPECT_LE(worst_ulps(1e290, 1e300, packed, logl), 2.0);
}

TEST(PackLog, EndsAreInfinityAndNotANumber) {
  EXPECT_EQ(math::log(Pack(0.0))[0], -pack_infinity);
  EXPECT_EQ(math::log(Pack(pack_infinity))[0], pack_infinity);
  EXPECT_EQ(math::log(Pack(1.0))[0], 0.0);
  EXPECT_TRUE(std::isnan(math::log(Pack(-1.0))[0]));
  EXPECT_TRUE(std::isnan(math::log(Pack(std::nan("")))[0]));
}

TEST(PackPow, AgreesWithTheLibraryWithinItsStatedError) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 10000; ++trial) {
    const Pack x = uniform_lanes(random, 1e-6, 3.0);
    const Pack y = math::pow(x, Pack(0.26));
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      EXPECT_NEAR(y[lane] / std::pow(x[lane], 0.26), 1.0, 2e-15);
    }
  }
  EXPECT_EQ(math::pow(Pack(0.0), Pack(0.26))[0], 0.0);
}

TEST(PackSelect, ChoosesLaneByLane) {
  Pack x(0.0);
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) x.set(lane, static_cast<double>(lane));
  const math::Mask low = x < Pack(3.0);
  const Pack y = math::select(low, Pack(-1.0), x);
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    EXPECT_EQ(y[lane], lane < 3 ? -1.0 : static_cast<double>(lane));
  }
  const auto count = [](math::Mask lanes) { return math::sum(math::select(lanes, Pack(1.0), Pack(0.0))); };
  const double width = static_cast<double>(math::pack_width), below_three = std::min(width, 3.0);
  EXPECT_EQ(count(low), below_three);
  EXPECT_EQ(count(!low), width - below_three);
  EXPECT_EQ(count(low & (x > Pack(0.0))), below_three - 1.0);
  EXPECT_EQ(count(low | (x >= Pack(width - 1.0))), std::min(width, 4.0));
}

TEST(PackAny, SeesASingleLane) {
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    Pack x(0.0);
    x.set(lane, 1.0);
    EXPECT_TRUE(math::any(x > Pack(0.5)));
    EXPECT_FALSE(math::any(x > Pack(1.5)));
  }
  EXPECT_FALSE(math::any(Pack(std::nan("")) > Pack(0.0)));
}

TEST(PackSum, AddsPairwiseInAFixedOrder) {
  Pack x(0.0);
  const double values[] = {1e16, 1.0, -1e16, 1.0, 3.0, 4.0, 5.0, 6.0};
  std::vector<double> sums;
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    x.set(lane, values[lane]);
    sums.push_back(values[lane]);
  }
  while (sums.size() > 1) {
    for (std::size_t k = 0; 2 * k < sums.size(); ++k) sums[k] = sums[2 * k] + sums[2 * k + 1];
    sums.resize(sums.size() / 2);
  }
  EXPECT_EQ(math::sum(x), sums[0]);
  EXPECT_EQ(math::largest(x), 1e16);
}

TEST(PackMovedUp, StartsWithTheLastLaneBefore) {
  Pack before(0.0), x(0.0);
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    before.set(lane, 10.0 + static_cast<double>(lane));
    x.set(lane, static_cast<double>(lane));
  }
  const Pack moved = math::moved_up(before, x);
  EXPECT_EQ(moved[0], 9.0 + math::pack_width);
  for (std::size_t lane = 1; lane < math::pack_width; ++lane) {
    EXPECT_EQ(moved[lane], static_cast<double>(lane - 1));
    EXPECT_EQ(math::lane_numbers[lane], static_cast<std::int64_t>(lane));
  }
}

TEST(PackMaxMin, PassNotANumberInTheFirstPlaceOn) {
  EXPECT_TRUE(std::isnan(math::max(Pack(std::nan("")), Pack(1.0))[0]));
  EXPECT_TRUE(std::isnan(math::min(Pack(std::nan("")), Pack(1.0))[0]));
  EXPECT_EQ(math::abs(Pack(-2.0))[0], 2.0);
}

}  // namespace
