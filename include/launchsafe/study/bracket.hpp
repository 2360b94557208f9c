// The critical gap, the smallest that ignites: found by scanning and bisection on one bottom trace, what
// makes it uncertain, cause by cause, and the bounds that follow. The table of causes in studies/README.md is
// this one.
#pragma once

#include "launchsafe/math/numbers.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// One critical gap: metres; 0 where it ignites without a gap, infinite where nothing ignites up to the end
/// of the search, NaN where it is not known.
using GapOrBound = double;
inline constexpr GapOrBound no_ignition = math::infinity;

/// Random: it differs from launch to launch. Knowledge: it is one fixed thing that nobody knows better.
enum class ShareClass { random, knowledge };

enum class ShareKind {
  peak_pressure,
  pulse_length,
  initial_temperature,
  stated_inputs,
  load_curve,
  computation,
  sliding,
  fit,
  model_form,
  accepted  ///< constants of gap and friction that are accepted and not the calibrated ones
};
inline constexpr std::size_t share_kinds = static_cast<std::size_t>(ShareKind::accepted) + 1;

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
  GapOrBound raised = math::not_a_number;   ///< at the end towards ignition
  GapOrBound lowered = math::not_a_number;  ///< at the other end
};

/// Random causes are raised by this many standard deviations: 97.7 % one-sided of a normal distribution, and
/// so at least 95 %.
inline constexpr double coverage_factor = 2.0;

/// Bounds of a critical gap, m.
struct GapBounds {
  GapOrBound at_least = math::not_a_number;  ///< NaN where a share is not known
  GapOrBound at_most = math::not_a_number;
};

/// Bounds around a critical gap between `safe` and `igniting` (m; both are the end of the search where
/// nothing ignites). Every share moves it by the distance from there to the critical gap of its raised case,
/// never the other way. The moves of random causes are combined by the root of the sum of their squares; the
/// moves of causes of knowledge, all at their worst ends, are added. No share makes the lower bound larger or
/// the upper one smaller; one that is not known leaves no bound on its side.
GapBounds bounds_of(double safe, double igniting, const std::vector<GapShare>& shares);

/// m by which one share lowers the bound; NaN where it is not known.
double move_towards_ignition(double safe, const GapShare& share);

enum class CriticalGapKind {
  value,             ///< between `lower` and `upper`
  all_safe,          ///< more than `lower`, where the search ended: a bound, not a value
  all_ignite,        ///< ignition even at `upper`, where the search began: a bound, not a value
  indeterminate,     ///< see the reason
  several_crossings  ///< gaps beyond some that ignite are safe again; `lower` and `upper` are at the first
                     ///< crossing
};
std::string to_string(CriticalGapKind kind);

/// Why a critical gap is no value; the words are in statement_text.cpp.
enum class GapReasonCode {
  none,              ///< it is one
  undefined,         ///< the temperature at `gap` is not a number
  end_of_search,     ///< no ignition up to `gap`
  not_monotone,      ///< no ignition at `gap` again
  always,            ///< ignition at every gap
  failed,            ///< the run, `because`
  validity_warning,  ///< of the run or its input, `because`
  coupled_failed,    ///< the coupled run at `gap`, `because`; traced was a bracket from `lower` to `upper`
  coupled_ignites,
  coupled_safe
};
struct GapReason {
  GapReasonCode code = GapReasonCode::none;
  double gap = math::not_a_number, lower = gap, upper = gap;  ///< m
  std::string because = {};                                   ///< what a run or an input says itself
};
std::string text_of(const GapReason& reason);

/// A critical gap. What a kind does not have is NaN: a bound has no value.
struct CriticalGap {
  CriticalGapKind kind = CriticalGapKind::indeterminate;
  double value = math::not_a_number;  ///< m, middle of the bracket
  double lower = value;               ///< m, does not ignite
  double upper = value;               ///< m, ignites
  GapReason reason = {};              ///< why it is no value
  std::vector<GapShare> shares = {};  ///< what makes it uncertain; once known
  GapBounds bounds = {};              ///< that follow; NaN until the shares are known
  /// Of one that is indeterminate for want of an acceptance alone: what the search found, on which nothing
  /// rests; NaN otherwise.
  GapOrBound indicative = math::not_a_number;
};

/// m: where the widest search ends that a study may ask for. Without ignition up to there a lower bound may
/// lie in the first part of it; an earlier end says nothing of what lies beyond, and gives no bound but 0.
constexpr double widest_search = 0.01, known_part_of_search = 0.5;

/// Takes the shares, and draws the bounds from them. Nothing can be said of one that is indeterminate.
void set_shares(CriticalGap& gap, std::vector<GapShare> shares);

GapOrBound gap_or_bound(const CriticalGap& gap);

/// A gap (m) as a reason tells it: "0.0395 cm".
std::string in_centimetres(double gap);

/// Whether a gap (m) ignites; nothing where that is undefined.
using Ignites = std::function<std::optional<bool>(double gap)>;

/// Scans from 0 to `largest` (m) in equal steps, narrows the first change from safe to ignites down, and
/// centres a bracket of width `tolerance` (m) on it. A gap that is undefined makes the result indeterminate,
/// one that is safe beyond the change makes it one of several crossings, and the reason names it.
CriticalGap find_critical_gap(const Ignites& ignites, double largest, double tolerance);

/// The smallest gap that ignites between `begin` and `end` (m), from a scan in equal steps and a bisection
/// down to `tolerance` (m): the lower end of its bracket, `begin` where that ignites, infinite where none
/// does, NaN where a state is undefined.
GapOrBound smallest_igniting_gap(const Ignites& ignites, double begin, double end, double tolerance);

}  // namespace launchsafe::study
