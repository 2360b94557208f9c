#include "launchsafe/study/bracket.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

/// All moves in one direction as one, m.
template <class Move>
double combined(const std::vector<GapShare>& shares, Move move) {
  double squares = 0.0, sum = 0.0;
  for (const GapShare& share : shares) {
    const double distance = move(share);
    if (traits_of(share.kind).of_class == ShareClass::random)
      squares += distance * distance;
    else
      sum += distance;
  }
  return std::sqrt(squares) + sum;
}

/// A length that is not negative; NaN stays NaN.
double not_negative(double length) { return length < 0.0 ? 0.0 : length; }

/// Intervals of the scan; a change and back again within one of them stays unseen.
constexpr int scan_intervals = 32;
/// The bisection goes this much further than the tolerance before the bracket is centred on the change.
constexpr double refinement = 64.0;

CriticalGap undefined_at(double gap) { return {.reason = {GapReasonCode::undefined, gap}}; }

struct Bracket {
  double lower, upper;
};

/// Halves a bracket down to `width`. Where a state is undefined, that gap and no upper end (NaN).
Bracket bisect(const Ignites& ignites, Bracket bracket, double width) {
  while (bracket.upper - bracket.lower > width) {
    const double middle = 0.5 * (bracket.lower + bracket.upper);
    if (middle <= bracket.lower || middle >= bracket.upper) break;
    const std::optional<bool> here = ignites(middle);
    if (!here) return {middle, math::not_a_number};
    (*here ? bracket.upper : bracket.lower) = middle;
  }
  return bracket;
}

/// A bracket of nearly the tolerance with the change in its middle, so that a confirmation stands clear of it
/// on both sides. Sides that do not hold keep the narrow bracket's.
Bracket centred(const Ignites& ignites, const Bracket& narrow, double tolerance) {
  const double middle = 0.5 * (narrow.lower + narrow.upper);
  const double half = 0.5 * tolerance * (1.0 - 1e-9);
  Bracket wide{std::max(0.0, middle - half), middle + half};
  if (wide.lower > narrow.lower || ignites(wide.lower) != false) wide.lower = narrow.lower;
  if (wide.upper < narrow.upper || ignites(wide.upper) != true) wide.upper = narrow.upper;
  return wide;
}

}  // namespace

const ShareTraits& traits_of(ShareKind kind) {
  using enum ShareClass;
  static const std::array<ShareTraits, share_kinds> traits{{
      {"peak_pressure", "peak pressure", random, "a measured spread of the peak pressure"},
      {"pulse_length", "length of the pulse", random, "measured curves of several rounds"},
      {"initial_temperature", "initial temperature", random, "a narrower range of temperatures"},
      {"stated_inputs", "inputs, as stated", random, "a better known launch"},
      {"load_curve", "errors of the measured curve", knowledge,
       "a gauge that samples faster, or less smoothing"},
      {"computation", "computation", knowledge, "a finer setting, or a record of its accuracy"},
      {"sliding", "sliding at the base", knowledge, "a base that holds the charge"},
      {"fit", "calibrated constants", knowledge, "more measured temperatures to calibrate on"},
      {"model_form", "other models", knowledge, "measurements of how the shell holds the charge"},
      {"accepted", "accepted constants, which the calibration has otherwise", knowledge,
       "a calibration with these constants"},
  }};
  return traits.at(static_cast<std::size_t>(kind));
}

std::string to_string(ShareClass of_class) { return of_class == ShareClass::random ? "random" : "knowledge"; }

double move_towards_ignition(double safe, const GapShare& share) {
  return share.raised == no_ignition ? 0.0 : not_negative(safe - share.raised);
}

GapBounds bounds_of(double safe, double igniting, const std::vector<GapShare>& shares) {
  const double down =
      combined(shares, [&](const GapShare& share) { return move_towards_ignition(safe, share); });
  const double up =
      combined(shares, [&](const GapShare& share) { return not_negative(share.lowered - igniting); });
  return {not_negative(safe - down), igniting + up};
}

std::string to_string(CriticalGapKind kind) {
  constexpr std::array words{"value", "all-safe", "all-ignite", "indeterminate", "several-crossings"};
  return words.at(static_cast<std::size_t>(kind));
}

std::string in_centimetres(double gap) { return fmt::format("{:.6g} cm", 100.0 * gap); }

GapOrBound gap_or_bound(const CriticalGap& gap) {
  if (gap.kind == CriticalGapKind::value) return gap.value;
  if (gap.kind == CriticalGapKind::all_safe) return no_ignition;
  return gap.kind == CriticalGapKind::all_ignite ? 0.0 : math::not_a_number;
}

CriticalGap find_critical_gap(const Ignites& ignites, double largest, double tolerance) {
  std::vector<double> gaps;
  std::vector<std::optional<bool>> states;
  for (int i = 0; i <= scan_intervals; ++i) {
    gaps.push_back(largest * i / scan_intervals);
    states.push_back(ignites(gaps.back()));
    if (!states.back()) return undefined_at(gaps.back());
  }
  CriticalGap result;
  const auto first = std::ranges::find(states, true);
  const auto index = static_cast<std::size_t>(first - states.begin());
  if (first == states.end()) {
    result.kind = CriticalGapKind::all_safe;
    result.lower = largest;
    result.reason = {GapReasonCode::end_of_search, largest};
    return result;
  }
  const auto again = std::find(first, states.end(), false);
  if (again != states.end())
    result.reason = {GapReasonCode::not_monotone, gaps[static_cast<std::size_t>(again - states.begin())]};
  if (index == 0) {
    result.kind = CriticalGapKind::all_ignite;
    result.upper = 0.0;
    if (again == states.end()) result.reason = {GapReasonCode::always};
    return result;
  }
  const Bracket narrow = bisect(ignites, {gaps[index - 1], gaps[index]}, tolerance / refinement);
  if (std::isnan(narrow.upper)) return undefined_at(narrow.lower);
  const Bracket bracket = centred(ignites, narrow, tolerance);
  result.kind = again == states.end() ? CriticalGapKind::value : CriticalGapKind::several_crossings;
  result.lower = bracket.lower;
  result.upper = bracket.upper;
  if (result.kind == CriticalGapKind::value) result.value = 0.5 * (bracket.lower + bracket.upper);
  return result;
}

GapOrBound smallest_igniting_gap(const Ignites& ignites, double begin, double end, double tolerance) {
  constexpr int intervals = 8;
  double safe = begin;
  for (int i = 0; i <= intervals; ++i) {
    const double gap = begin + (end - begin) * i / intervals;
    const std::optional<bool> here = ignites(gap);
    if (!here) return math::not_a_number;
    if (!*here) {
      safe = gap;
      continue;
    }
    if (i == 0) return begin;
    const Bracket bracket = bisect(ignites, {safe, gap}, tolerance);
    // The lower end, so that no share towards ignition is told smaller than it is.
    return std::isnan(bracket.upper) ? math::not_a_number : bracket.lower;
  }
  return no_ignition;
}

void set_shares(CriticalGap& gap, std::vector<GapShare> shares) {
  gap.shares = std::move(shares);
  gap.bounds = {};
  if (gap.kind == CriticalGapKind::value) gap.bounds = bounds_of(gap.lower, gap.upper, gap.shares);
  // A critical gap beyond the end of the search may have its bound anywhere before it: shares without an
  // ignition up to there are not 0, but unknown. Of gaps that the widest search knows the margin decides too.
  if (gap.kind == CriticalGapKind::all_safe)
    gap.bounds = {gap.lower < widest_search ? 0.0
                                            : std::min(bounds_of(gap.lower, gap.lower, gap.shares).at_least,
                                                       known_part_of_search * gap.lower),
                  no_ignition};
  if (gap.kind == CriticalGapKind::all_ignite)
    gap.bounds = {0.0, bounds_of(gap.upper, gap.upper, gap.shares).at_most};
}

}  // namespace launchsafe::study
