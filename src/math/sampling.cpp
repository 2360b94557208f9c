#include "launchsafe/math/sampling.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/random/sobol.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace launchsafe::math {
namespace {

constexpr double root_half = boost::math::constants::one_div_root_two<double>();

/// Probabilities of the standard normal below and above z.
double normal_below(double z) { return 0.5 * std::erfc(-z * root_half); }
double normal_above(double z) { return 0.5 * std::erfc(z * root_half); }

/// Probability of the standard normal between a <= b, without cancellation of numbers near 1.
double normal_between(double a, double b) {
  if (a >= 0.0) return normal_above(a) - normal_above(b);
  if (b <= 0.0) return normal_below(b) - normal_below(a);
  return 0.5 * (std::erf(b * root_half) - std::erf(a * root_half));
}

/// z with the probability p in [0, 0.5] below it.
double lower_normal_quantile(double p) {
  constexpr double smallest = std::numeric_limits<double>::min();
  return -boost::math::erfc_inv(2.0 * std::max(p, smallest)) / root_half;
}

/// z with the probability u in (0, 1) below it.
double standard_normal_quantile(double u) {
  return u < 0.5 ? lower_normal_quantile(u) : -lower_normal_quantile(1.0 - u);
}

double standardised(const Distribution& distribution, double x) {
  return (x - distribution.centre) / distribution.deviation;
}

/// The ends of a normal in deviations from its centre.
std::pair<double, double> standard_ends(const Distribution& distribution) {
  return {standardised(distribution, distribution.lower), standardised(distribution, distribution.upper)};
}

double normal_quantile(const Distribution& distribution, double u) {
  const auto [begin, end] = standard_ends(distribution);
  const double inside = normal_between(begin, end);
  const double below = normal_below(begin) + u * inside;
  const double above = normal_above(end) + (1.0 - u) * inside;
  // The smaller probability is the one that is known to its last digits.
  const double z = below < above ? lower_normal_quantile(below) : -lower_normal_quantile(above);
  return distribution.centre + distribution.deviation * z;
}

/// ln(upper/lower), also of ends close to each other.
double log_ratio(const Distribution& distribution) {
  return std::log1p((distribution.upper - distribution.lower) / distribution.lower);
}

/// (bits + 1/2)/2^52 of the 52 leading bits: never 0 and never 1, and exact.
double open_unit(std::uint64_t word) { return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52; }

/// Owen's nested uniform scramble of the 32 digits of a number: each bit is flipped or not by a hash of the
/// bits above it. These, with a leading one, number the nodes of a binary tree. Below the 32 bits the leaf's
/// own hash goes on (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995).
std::uint64_t nested_scramble(std::uint32_t digits, std::uint64_t key) {
  const std::uint64_t leaf = (std::uint64_t{1} << 32) | digits;
  std::uint64_t flips = 0;
  for (std::uint64_t bit = 0; bit < 32; ++bit) flips |= hashed(key, leaf >> (bit + 1)) >> 63 << bit;
  return ((digits ^ flips) << 32) | (hashed(key, leaf) >> 32);
}

}  // namespace

Distribution Distribution::uniform(double lower, double upper) { return {Kind::uniform, lower, upper, 0, 1}; }

Distribution Distribution::log_uniform(double lower, double upper) {
  return {Kind::log_uniform, lower, upper, 0, 1};
}

Distribution Distribution::normal(double centre, double deviation, double lower, double upper) {
  return {Kind::normal, lower, upper, centre, deviation};
}

Distribution Distribution::log_normal(double median, double deviation) {
  return {Kind::log_normal, 0.0, infinity, median, deviation};
}

bool is_valid(const Distribution& distribution) {
  const auto& [kind, lower, upper, centre, deviation] = distribution;
  if (!(lower < upper)) return false;
  if (kind == Distribution::Kind::uniform) return std::isfinite(upper - lower);
  if (kind == Distribution::Kind::log_uniform) return lower > 0.0 && std::isfinite(upper / lower);
  if (!std::isfinite(centre) || !std::isfinite(deviation) || !(deviation > 0.0)) return false;
  if (kind == Distribution::Kind::log_normal) return centre > 0.0;
  const auto [begin, end] = standard_ends(distribution);
  return normal_between(begin, end) >= 1e-280;
}

double quantile(const Distribution& distribution, double u) {
  assert(is_valid(distribution) && u >= 0.0 && u <= 1.0);
  const double lower = distribution.lower, upper = distribution.upper;
  if (u <= 0.0) return lower;
  if (u >= 1.0) return upper;
  const auto inside = [&] {
    switch (distribution.kind) {
      case Distribution::Kind::uniform:
        return (1.0 - u) * lower + u * upper;
      case Distribution::Kind::log_uniform:
        return lower * std::exp(u * log_ratio(distribution));
      case Distribution::Kind::log_normal:
        return distribution.centre * std::exp(distribution.deviation * standard_normal_quantile(u));
      case Distribution::Kind::normal:
        break;
    }
    return normal_quantile(distribution, u);
  };
  return std::clamp(inside(), lower, upper);
}

std::optional<std::vector<double>> covariance_factor(const std::vector<double>& covariance,
                                                     std::size_t size) {
  assert(covariance.size() == size * size);
  std::vector<double> factor(size * size, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (covariance[i * size + j] != covariance[j * size + i]) return std::nullopt;
      double rest = covariance[i * size + j];
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i * size + k] * factor[j * size + k];
      if (i == j && !(rest > 0.0)) return std::nullopt;
      factor[i * size + j] = i == j ? std::sqrt(rest) : rest / factor[j * size + j];
    }
  }
  return factor;
}

std::uint64_t hashed(std::uint64_t key, std::uint64_t n) {
  std::uint64_t z = key + 0x9e3779b97f4a7c15u * (n + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::uint32_t SplitMix64::below(std::uint32_t bound) {
  return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32);
}

std::vector<double> unit_points(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  assert(points < (std::uint64_t{1} << 32));
  std::vector<double> values(points * dimensions);
  if (values.empty()) return values;
  boost::random::sobol_engine<std::uint32_t, 32> sequence(dimensions);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint32_t digits = k < dimensions ? 0u : sequence();  // Boost leaves the origin out
    values[k] = open_unit(nested_scramble(digits, hashed(seed, k % dimensions)));
  }
  return values;
}

std::vector<double> point_of_row(const std::vector<double>& points, std::size_t row, std::size_t dimensions) {
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(row * dimensions);
  return {begin, begin + static_cast<std::ptrdiff_t>(dimensions)};
}

}  // namespace launchsafe::math
