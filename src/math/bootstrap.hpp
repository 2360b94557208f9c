// Bootstrap intervals of statistics.
#pragma once

#include "launchsafe/math/sampling.hpp"
#include "launchsafe/math/sensitivity.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace launchsafe::math {

inline constexpr Estimate no_estimate{std::numeric_limits<double>::quiet_NaN(),
                                      std::numeric_limits<double>::quiet_NaN(),
                                      std::numeric_limits<double>::quiet_NaN()};

/// How often each of `size` members is drawn when `size` are drawn with replacement.
std::vector<double> resampling_counts(std::size_t size, SplitMix64& random);

/// Percentile interval from the replicates of a statistic of `size` independent members, with the percentiles
/// moved out by what Student's t of size - 1 degrees exceeds the normal (Hesterberg, "What teachers should
/// know about the bootstrap", Am. Stat. 69, 2015): plain percentiles are too narrow for small samples. Bias
/// correction, with acceleration or without, was measured to cover less often than this.
Estimate with_interval(double value, std::vector<double> replicates, std::size_t size, double level);

}  // namespace launchsafe::math
