// Comparing estimates with their intervals.
#pragma once

#include "launchsafe/math/sensitivity.hpp"

namespace launchsafe::math {

inline bool holds(const Estimate& estimate, double truth) {
  return estimate.lower <= truth && truth <= estimate.upper;
}

inline bool same(const Estimate& a, const Estimate& b) {
  return a.value == b.value && a.lower == b.lower && a.upper == b.upper;
}

}  // namespace launchsafe::math
