// The smallest gap that ignites, by scanning and bisection on one bottom trace.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <functional>
#include <limits>
#include <string>

namespace launchsafe::study {

enum class CriticalGapKind {
  value,         ///< between `lower` and `upper`
  all_safe,      ///< more than `lower`, where the search ended: a bound, not a value
  all_ignite,    ///< ignition even at `upper`, where the search began: a bound, not a value
  indeterminate  ///< see the reason
};
std::string to_string(CriticalGapKind kind);

/// A critical gap. What a kind does not have is NaN: a bound has no value.
struct CriticalGap {
  CriticalGapKind kind = CriticalGapKind::indeterminate;
  double value;        ///< m, middle of the bracket
  double lower;        ///< m, does not ignite
  double upper;        ///< m, ignites
  double uncertainty;  ///< m, half the bracket and the temperature uncertainty over the slope; once known
  std::string reason;  ///< why it is a bound or indeterminate, or what is to be known about the value
  CriticalGap();
};

/// One critical gap: metres; 0 where it ignites without a gap, infinite where nothing ignites up to the end
/// of the search, NaN where it is not known.
using GapOrBound = double;
inline constexpr GapOrBound no_ignition = std::numeric_limits<double>::infinity();
GapOrBound gap_or_bound(const CriticalGap& gap);

/// What a gap (m) does.
enum class GapState { safe, ignites, undefined };

/// Scans from 0 to `largest` (m) in equal steps, narrows the first change from safe to ignites down, and
/// centres a bracket of width `tolerance` (m) on it. A gap that is undefined makes the result indeterminate,
/// one that is safe beyond the change is named in the reason.
CriticalGap find_critical_gap(const std::function<GapState(double gap)>& state, double largest,
                              double tolerance);

}  // namespace launchsafe::study
