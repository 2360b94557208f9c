// The critical gap, the smallest that ignites, on one bottom trace: found by scanning and bisection.
#pragma once

#include "launchsafe/math/numbers.hpp"

#include <functional>
#include <optional>
#include <string>

namespace launchsafe::study {

/// One critical gap: metres; 0 where it ignites without a gap, infinite where nothing ignites up to the end
/// of the search, NaN where it is not known.
using GapOrBound = double;
inline constexpr GapOrBound no_ignition = math::infinity;

/// m: where a search for the critical gap ends at the latest.
inline constexpr double widest_search = 0.01;
/// m: how exactly a critical gap is solved on its trace.
inline constexpr double gap_accuracy = 1e-8;

enum class CriticalGapKind {
  unknown,           ///< nothing was computed, or a temperature is not a number
  value,             ///< a number
  all_safe,          ///< no ignition up to `value`, where the search ended
  all_ignite,        ///< ignition without a gap; `value` is 0
  several_crossings  ///< a gap beyond `value`, the first that ignites, does not ignite
};
std::string to_string(CriticalGapKind kind);

struct CriticalGap {
  CriticalGapKind kind = CriticalGapKind::unknown;
  double value = math::not_a_number;  ///< m; the end of the search where nothing ignites
};

/// A critical gap as one number; the first crossing where there are several.
GapOrBound gap_or_bound(const CriticalGap& gap);

/// Whether a gap (m) ignites; nothing where that is undefined.
using Ignites = std::function<std::optional<bool>(double gap)>;

/// Scans from 0 to `largest` (m), in steps that grow with the gap, and narrows the first change from safe to
/// ignites down to gap_accuracy.
CriticalGap find_critical_gap(const Ignites& ignites, double largest);

/// The smallest gap that ignites up to `largest` (m), sought near `guess` (m) first: for causes that move a
/// critical gap by little. NaN where a state is undefined.
GapOrBound critical_gap_near(const Ignites& ignites, double guess, double largest);

}  // namespace launchsafe::study
