#include "launchsafe/math/sampling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace {

namespace math = launchsafe::math;
using math::Distribution;

constexpr double no_bound = std::numeric_limits<double>::infinity();
/// Values of one column of a design.
std::vector<double> column(const std::vector<double>& points, std::size_t dimensions, std::size_t which) {
  std::vector<double> values;
  for (std::size_t k = which; k < points.size(); k += dimensions) values.push_back(points[k]);
  return values;
}

std::size_t cell_of(double value, std::size_t cells) {
  return static_cast<std::size_t>(value * static_cast<double>(cells));
}

/// True where each of as many equal intervals as there are values holds one of them.
bool fills_every_interval(const std::vector<double>& values) {
  std::vector<int> count(values.size(), 0);
  for (const double value : values) ++count.at(cell_of(value, values.size()));
  return std::all_of(count.begin(), count.end(), [](int n) { return n == 1; });
}

/// True where each elementary rectangle of area 2^-power of the first two columns holds one point.
bool is_plane_net(const std::vector<double>& points, std::size_t dimensions, unsigned power) {
  for (unsigned k = 0; k <= power; ++k) {
    const std::size_t wide = std::size_t{1} << k, high = std::size_t{1} << (power - k);
    std::vector<int> count(wide * high, 0);
    for (std::size_t i = 0; i < points.size(); i += dimensions) {
      ++count.at(cell_of(points[i], wide) * high + cell_of(points[i + 1], high));
    }
    if (std::any_of(count.begin(), count.end(), [](int n) { return n != 1; })) return false;
  }
  return true;
}

/// Root mean square error over seeds of the mean of e^x at the points of one dimension.
double error_of_exponential(std::size_t points) {
  constexpr int seeds = 200;
  double total = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    double mean = 0.0;
    for (const double x : math::unit_points(points, 1, seed)) mean += std::exp(x);
    const double error = mean / static_cast<double>(points) - (std::numbers::e - 1.0);
    total += error * error;
  }
  return std::sqrt(total / seeds);
}

/// Standard normal distribution by the standard library, the tests' own.
double phi_below(double z) { return 0.5 * (1.0 + std::erf(z / std::numbers::sqrt2)); }

/// Share of the standard normal from a to b, a <= b, by the tail that is the smaller.
double phi_between(double a, double b) {
  const double turn = a + b > 0.0 ? 1.0 : -1.0;
  const auto beyond = [](double z) { return std::erfc(z / std::numbers::sqrt2); };
  return 0.5 * std::abs(beyond(turn * a) - beyond(turn * b));
}

/// Share in [0, 1] of a distribution below x.
double share_below(const Distribution& distribution, double x) {
  const auto& [kind, lower, upper, centre, deviation] = distribution;
  if (kind == Distribution::Kind::uniform) return (x - lower) / (upper - lower);
  if (kind == Distribution::Kind::log_uniform)
    return std::log1p((x - lower) / lower) / std::log1p((upper - lower) / lower);
  const auto z = [&](double at) { return (at - centre) / deviation; };
  return phi_between(z(lower), z(x)) / phi_between(z(lower), z(upper));
}

TEST(SplitMix64, GivesThePublishedNumbers) {
  // Seed 1234567, the check values given with Vigna's splitmix64.c on Rosetta Code.
  math::SplitMix64 random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u}) {
    EXPECT_EQ(random.next(), expected);
  }
  EXPECT_EQ(math::hashed(1234567, 4), 16408922859458223821u);
}

TEST(UnitPoints, AreTheSameToTheLastBitEverywhere) {
  // From a separate implementation in Python's integers, with the first rows of new-joe-kuo-6.
  const auto sobol = math::unit_points(6, 3, 7);
  const double first[] = {0x1.b795ef5b2c067p-1, 0x1.955606d88fe0bp-1, 0x1.7c111826e06a5p-1};
  const double sixth[] = {0x1.a0bf4c0202fc8p-4, 0x1.e0da37f41cd74p-3, 0x1.3615174c183e3p-1};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(sobol[k], first[k]);
    EXPECT_EQ(sobol[15 + k], sixth[k]);
  }
}

TEST(UnitPoints, LieInsideTheOpenCube) {
  for (const std::size_t points : {1, 2, 1000}) {
    const auto values = math::unit_points(points, 20, 3);
    EXPECT_EQ(values.size(), points * 20);
    EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.0);
    EXPECT_LT(*std::max_element(values.begin(), values.end()), 1.0);
  }
  EXPECT_TRUE(math::unit_points(0, 3, 1).empty());
  EXPECT_TRUE(math::unit_points(3, 0, 1).empty());
}

TEST(UnitPoints, EachPointIsUniformOverSeeds) {
  constexpr int seeds = 4000;
  std::vector<double> mean(8, 0.0), square(8, 0.0);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const auto values = math::unit_points(4, 2, seed);
    for (std::size_t k = 0; k < 8; ++k) {
      mean[k] += values[k] / seeds;
      square[k] += values[k] * values[k] / seeds;
    }
  }
  for (std::size_t k = 0; k < 8; ++k) {
    // Four standard errors: sqrt(1/12/4000) of the mean, sqrt(4/45/4000) of the square.
    EXPECT_NEAR(mean[k], 1.0 / 2.0, 0.0183);
    EXPECT_NEAR(square[k], 1.0 / 3.0, 0.0189);
  }
}

TEST(UnitPoints, LongerDesignsStartWithTheShorterOnes) {
  auto longer = math::unit_points(200, 5, 11);
  longer.resize(500);
  EXPECT_EQ(longer, math::unit_points(100, 5, 11));
}

TEST(ScrambledSobol, HasOnePointInEveryIntervalOfEachCoordinate) {
  for (unsigned power = 0; power <= 10; ++power) {
    const auto values = math::unit_points(std::size_t{1} << power, 40, 5);
    for (std::size_t k = 0; k < 40; ++k) EXPECT_TRUE(fills_every_interval(column(values, 40, k))) << power;
  }
}

TEST(ScrambledSobol, FirstTwoCoordinatesAreANet) {
  for (unsigned power = 0; power <= 10; ++power) {
    EXPECT_TRUE(is_plane_net(math::unit_points(std::size_t{1} << power, 3, 9), 3, power));
  }
}

TEST(ScrambledSobol, IsNestedAndNotAShift) {
  // In one dimension Owen's scramble is stratified sampling, error N^-3/2, where a random shift of the digits
  // leaves N^-1: from 64 to 1024 points a factor of 64 against 16.
  const double coarse = error_of_exponential(64);
  const double fine = error_of_exponential(1024);
  EXPECT_NEAR(std::log2(coarse / fine) / 4.0, 1.5, 0.1);
  // The variance within the strata: the mean of (f'/N)^2/12 over N points, f' = e^x.
  EXPECT_NEAR(fine * std::pow(1024.0, 1.5) / std::sqrt((std::exp(2.0) - 1.0) / 24.0), 1.0, 0.15);
}

TEST(ScrambledSobol, RefusesMoreDimensionsThanItsTableHas) {
  EXPECT_EQ(math::unit_points(1, 3667, 1).size(), 3667u);
  EXPECT_THROW(math::unit_points(1, 3668, 1), std::invalid_argument);
}

TEST(Distribution, UniformAndLogUniformAreTheirFormulas) {
  EXPECT_NEAR(math::quantile(Distribution::uniform(-2.0, 6.0), 0.25), 0.0, 1e-15);
  const auto decades = Distribution::log_uniform(1e-3, 1e3);
  EXPECT_NEAR(math::quantile(decades, 0.5), 1.0, 1e-14);
  EXPECT_NEAR(math::quantile(decades, 1.0 / 3.0), 0.1, 1e-15);
}

TEST(Distribution, NormalAgreesWithTheTables) {
  const auto standard = Distribution::normal(0.0, 1.0);
  EXPECT_NEAR(math::quantile(standard, 0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(math::quantile(standard, 0.001), -3.090232306167813, 1e-14);
  EXPECT_NEAR(math::quantile(Distribution::normal(500.0, 20.0), 0.025), 500.0 - 20.0 * 1.959963984540054,
              1e-12);
}

TEST(Distribution, NormalCutOffFollowsFromTheErrorFunction) {
  const auto cut = Distribution::normal(10.0, 2.0, 8.0, 14.0);  // -1 to 2 deviations
  const double inside = phi_below(2.0) - phi_below(-1.0);
  EXPECT_NEAR(math::quantile(cut, (phi_below(0.5) - phi_below(-1.0)) / inside), 11.0, 1e-14);
  // Half of a normal: median at the three-quarter point of the whole.
  const auto half = Distribution::normal(0.0, 1.0, 0.0, no_bound);
  EXPECT_NEAR(math::quantile(half, 0.5), 0.674489750196082, 1e-14);
}

TEST(Distribution, QuantilesHaveTheirShareBelowThem) {
  for (const auto& distribution :
       {Distribution::uniform(-3.0, 5.0), Distribution::log_uniform(2e-9, 4e3),
        Distribution::log_uniform(1000.0, 1000.1), Distribution::normal(1.0, 3.0),
        Distribution::normal(1.0, 3.0, -no_bound, 2.0), Distribution::normal(1.0, 3.0, 0.0, 2.0),
        Distribution::normal(0.0, 1.0, 20.0, 21.0), Distribution::normal(0.0, 1.0, -no_bound, -34.0)}) {
    double last = -no_bound;
    for (int k = 1; k < 256; ++k) {
      const double u = k / 256.0, x = math::quantile(distribution, u);
      // As near as the neighbours of x, and as erfc whose argument z is rounded: z^2 eps, 34 deviations out.
      const double step = share_below(distribution, std::nextafter(x, no_bound)) -
                          share_below(distribution, std::nextafter(x, -no_bound));
      EXPECT_NEAR(share_below(distribution, x), u, step + 3e-13);
      EXPECT_GT(x, last);
      last = x;
    }
  }
}

TEST(Distribution, KnowsWhatIsNone) {
  EXPECT_TRUE(math::is_valid(Distribution::uniform(0.0, 1.0)));
  EXPECT_TRUE(math::is_valid(Distribution::normal(0.0, 1.0, 35.0)));
  EXPECT_FALSE(math::is_valid(Distribution::uniform(1.0, 1.0)));
  EXPECT_FALSE(math::is_valid(Distribution::uniform(0.0, no_bound)));
  EXPECT_FALSE(math::is_valid(Distribution::uniform(std::nan(""), 1.0)));
  EXPECT_FALSE(math::is_valid(Distribution::log_uniform(0.0, 1.0)));
  EXPECT_FALSE(math::is_valid(Distribution::log_uniform(1.0, no_bound)));
  EXPECT_FALSE(math::is_valid(Distribution::normal(0.0, 0.0)));
  EXPECT_FALSE(math::is_valid(Distribution::normal(0.0, -1.0)));
  EXPECT_FALSE(math::is_valid(Distribution::normal(no_bound, 1.0)));
  EXPECT_FALSE(math::is_valid(Distribution::normal(0.0, 1.0, 2.0, 1.0)));
  EXPECT_FALSE(math::is_valid(Distribution::normal(0.0, 1.0, 40.0)));  // nothing left to draw from
}

// By definition: the logarithm of the quantile is that of the median and so many deviations, 1.959964 at 97.5
// %.
TEST(LogNormal, IsNormalInItsLogarithm) {
  const auto distribution = math::Distribution::log_normal(2.0, 0.1);
  ASSERT_TRUE(math::is_valid(distribution));
  EXPECT_DOUBLE_EQ(math::quantile(distribution, 0.5), 2.0);
  EXPECT_NEAR(math::quantile(distribution, 0.975), 2.0 * std::exp(0.1959964), 1e-6);
  EXPECT_NEAR(math::quantile(distribution, 0.025), 2.0 * std::exp(-0.1959964), 1e-6);
  EXPECT_FALSE(math::is_valid(math::Distribution::log_normal(0.0, 0.1)));
}

// By hand: (2, 0; 1, sqrt(2)) times its transpose is (4, 2; 2, 3).
TEST(CovarianceFactor, TimesItsTransposeIsTheCovariance) {
  const auto factor = math::covariance_factor({4, 2, 2, 3}, 2);
  ASSERT_TRUE(factor);
  EXPECT_EQ((*factor)[0], 2.0);
  EXPECT_EQ((*factor)[1], 0.0);
  EXPECT_EQ((*factor)[2], 1.0);
  EXPECT_DOUBLE_EQ((*factor)[3], std::sqrt(2.0));
}

TEST(CovarianceFactor, OfWhatIsNoCovarianceIsNothing) {
  EXPECT_FALSE(math::covariance_factor({1, 2, 2, 1}, 2)) << "a correlation above 1";
  EXPECT_FALSE(math::covariance_factor({1, 1, 1, 1}, 2)) << "singular";
  EXPECT_FALSE(math::covariance_factor({1, 0.5, 0.2, 1}, 2)) << "not symmetric";
}

}  // namespace
