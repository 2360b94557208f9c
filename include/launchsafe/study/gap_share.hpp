// What makes the critical gap uncertain, cause by cause, and the bounds of the critical gap that follow. The
// table of causes in studies/README.md is this one.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace launchsafe::study {

/// One critical gap: metres; 0 where it ignites without a gap, infinite where nothing ignites up to the end
/// of the search, NaN where it is not known.
using GapOrBound = double;
inline constexpr GapOrBound no_ignition = std::numeric_limits<double>::infinity();

/// Random: it differs from launch to launch. Knowledge: it is one fixed thing that nobody knows better.
enum class ShareClass { random, knowledge };

enum class ShareKind {
  peak_pressure,
  pulse_length,
  initial_temperature,
  muzzle_exit,
  stated_inputs,
  load_curve,
  computation,
  sliding,
  fit,
  model_form,
  accepted  ///< constants of gap and friction that are accepted and not the calibrated ones
};
inline constexpr ShareKind last_share_kind = ShareKind::accepted;
inline constexpr std::size_t share_kinds = 11;

struct ShareTraits {
  std::string name;   ///< in files: "peak_pressure"
  std::string title;  ///< for people: "peak pressure"
  ShareClass of_class = ShareClass::knowledge;
  std::string remedy;  ///< what would make it smaller, for people
};
const ShareTraits& traits_of(ShareKind kind);
std::string to_string(ShareClass of_class);

/// What one cause does to the critical gap of a case.
struct GapShare {
  ShareKind kind = ShareKind::computation;
  GapOrBound raised = std::numeric_limits<double>::quiet_NaN();   ///< at the end towards ignition
  GapOrBound lowered = std::numeric_limits<double>::quiet_NaN();  ///< at the other end
};

/// Random causes are raised by this many standard deviations: 97.7 % one-sided of a normal distribution, and
/// so at least 95 %.
inline constexpr double coverage_factor = 2.0;

/// Bounds of a critical gap, m.
struct GapBounds {
  GapOrBound at_least = std::numeric_limits<double>::quiet_NaN();  ///< NaN where a share is not known
  GapOrBound at_most = std::numeric_limits<double>::quiet_NaN();
};

/// Bounds around a critical gap between `safe` and `igniting` (m; both are the end of the search where
/// nothing ignites). Every share moves it by the distance from there to the critical gap of its raised case,
/// never the other way. The moves of random causes are combined by the root of the sum of their squares; the
/// moves of causes of knowledge, all at their worst ends, are added. No share makes the lower bound larger or
/// the upper one smaller; one that is not known leaves no bound on its side.
GapBounds bounds_of(double safe, double igniting, const std::vector<GapShare>& shares);

/// m by which one share lowers the bound; NaN where it is not known.
double move_towards_ignition(double safe, const GapShare& share);

}  // namespace launchsafe::study
