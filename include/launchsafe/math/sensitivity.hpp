// Sensitivity of an output to uncertain inputs: variance-based (Sobol) indices with intervals from a
// bootstrap.
#pragma once

#include "launchsafe/math/sampling.hpp"

#include <string>

namespace launchsafe::math {

/// An estimate with the interval that holds the true value at the level asked for; all NaN without an
/// estimate, the interval alone where only the estimate exists.
struct Estimate {
  double value, lower, upper;
};

inline constexpr Estimate no_estimate{not_a_number, not_a_number, not_a_number};

/// How often each of `size` members is drawn when `size` are drawn with replacement.
std::vector<double> resampling_counts(std::size_t size, SplitMix64& random);

/// Percentile interval from the replicates of a statistic of `size` independent members, with the percentiles
/// moved out by what Student's t of size - 1 degrees exceeds the normal (Hesterberg, "What teachers should
/// know about the bootstrap", Am. Stat. 69, 2015): plain percentiles are too narrow for small samples. Bias
/// correction, with acceleration or without, was measured to cover less often than this.
Estimate with_interval(double value, std::vector<double> replicates, std::size_t size, double level);

struct SobolOptions {
  double level = 0.95;           ///< confidence of the intervals, in (0, 1)
  std::size_t resamples = 1000;  ///< of the bootstrap, at least 1
  std::uint64_t seed = 0;        ///< of the bootstrap
};

/// Shares of the variance of the output, of one input.
struct InputIndices {
  Estimate first;  ///< by the input alone; may fall below 0 by chance
  Estimate total;  ///< with all its interactions; never below 0
};

struct SobolIndices {
  double mean = 0;                   ///< of the output, its unit
  double variance = 0;               ///< of the output, its unit squared
  std::vector<InputIndices> inputs;  ///< in their order; all NaN where there is a reason
  std::string reason;                ///< why there are no indices; empty where there are
};

}  // namespace launchsafe::math
