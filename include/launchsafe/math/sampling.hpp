// Samples of uncertain inputs: distributions by their quantile function, and designs on the unit cube.
#pragma once

#include "launchsafe/math/numbers.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace launchsafe::math {

/// One uncertain input. A plain value; the functions below assert that it is valid, and whoever reads it from
/// a user asks `is_valid` first.
struct Distribution {
  enum class Kind { uniform, log_uniform, normal, log_normal };

  Kind kind = Kind::uniform;
  double lower = 0;  ///< least value, unit of the input; -infinity for a normal not cut off below
  double upper = 1;  ///< greatest value, unit of the input; infinity for a normal not cut off above
  /// Mean of the normal before it is cut off, or median of the log-normal, unit of the input; others ignore
  /// it.
  double centre = 0;
  /// Standard deviation of the normal before it is cut off, or of the logarithm of the log-normal.
  double deviation = 1;

  static Distribution uniform(double lower, double upper);
  /// The logarithm is uniform.
  static Distribution log_uniform(double lower, double upper);
  static Distribution normal(double centre, double deviation, double lower = -infinity,
                             double upper = infinity);
  /// The logarithm is normal, and not cut off.
  static Distribution log_normal(double median, double deviation);
};

/// lower < upper, a finite distance apart (uniform), with lower above 0 and upper/lower finite (log-uniform);
/// for a log-normal a finite median above 0 and a finite deviation above 0; for a normal a finite centre, a
/// finite deviation above 0, and a probability of at least 1e-280 before the cut between its ends, which an
/// end up to about 35 deviations beyond the centre leaves.
bool is_valid(const Distribution& distribution);

/// The value below which the share u in [0, 1] lies, unit of the input; the ends exactly at u = 0 and 1, and
/// so infinite where an end is. A normal keeps its relative accuracy when it is cut off far from its centre.
double quantile(const Distribution& distribution, double u);

/// The factor L of a covariance matrix L L^T of `size` variables, row by row, lower triangular: L z has that
/// covariance where z are independent standard normals. Nothing where the matrix is not symmetric and
/// positive definite.
std::optional<std::vector<double>> covariance_factor(const std::vector<double>& covariance, std::size_t size);

/// The n-th output (from 0) of the generator SplitMix64 seeded with `key`: a hash of both numbers (Steele,
/// Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014; constants of Vigna's
/// splitmix64.c). Integers only, hence the same on every machine.
std::uint64_t hashed(std::uint64_t key, std::uint64_t n);

/// The outputs of SplitMix64 one after the other.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : seed_(seed) {}

  std::uint64_t next() { return hashed(seed_, count_++); }
  /// A whole number from 0 to bound - 1; shares differ by less than bound/2^32 of themselves.
  std::uint32_t below(std::uint32_t bound);

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

/// `points` points (below 2^32) of the unit cube, row by row, every coordinate inside the open interval
/// (0, 1): Sobol's sequence (direction numbers of Joe and Kuo 2008) under Owen's nested scramble. A pure
/// function of its arguments, the same to the last bit on every machine. Each point by itself is uniform over
/// seeds. The first points of a longer design of the same seed are the shorter design. It balances best at a
/// power of two points and throws std::invalid_argument beyond 3667 dimensions.
std::vector<double> unit_points(std::size_t points, std::size_t dimensions, std::uint64_t seed);

/// One of points that lie row by row.
std::vector<double> point_of_row(const std::vector<double>& points, std::size_t row, std::size_t dimensions);

}  // namespace launchsafe::math
