#include "launchsafe/study/gap_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace launchsafe::study {
namespace {

/// Intervals of the scan; a change and back again within one of them stays unseen.
constexpr int scan_intervals = 48;

/// Gaps of the scan, m: their steps grow in proportion to the gap, from 0.03 mm for a search up to 1 cm.
double scanned_gap(int index, double largest) {
  const double share = static_cast<double>(index) / scan_intervals;
  return largest * share * (0.15 + 0.85 * share);
}

/// The middle of the change from safe to ignites, to gap_accuracy; NaN where a state is undefined.
double bisect(const Ignites& ignites, double safe, double igniting) {
  while (igniting - safe > gap_accuracy) {
    const double middle = 0.5 * (safe + igniting);
    const std::optional<bool> here = ignites(middle);
    if (!here) return math::not_a_number;
    (*here ? igniting : safe) = middle;
  }
  return 0.5 * (safe + igniting);
}

}  // namespace

std::string to_string(CriticalGapKind kind) {
  constexpr std::array words{"unknown", "value", "all-safe", "all-ignite", "several-crossings"};
  return words.at(static_cast<std::size_t>(kind));
}

GapOrBound gap_or_bound(const CriticalGap& gap) {
  return gap.kind == CriticalGapKind::all_safe ? no_ignition : gap.value;
}

CriticalGap find_critical_gap(const Ignites& ignites, double largest) {
  std::vector<bool> states;
  for (int i = 0; i <= scan_intervals; ++i) {
    const std::optional<bool> here = ignites(scanned_gap(i, largest));
    if (!here) return {};
    states.push_back(*here);
  }
  const auto first = std::ranges::find(states, true);
  if (first == states.end()) return {CriticalGapKind::all_safe, largest};
  const bool returns = std::find(first, states.end(), false) != states.end();
  const auto index = static_cast<int>(first - states.begin());
  const double value =
      index == 0 ? 0.0 : bisect(ignites, scanned_gap(index - 1, largest), scanned_gap(index, largest));
  if (std::isnan(value)) return {};
  if (returns) return {CriticalGapKind::several_crossings, value};
  return {index == 0 ? CriticalGapKind::all_ignite : CriticalGapKind::value, value};
}

GapOrBound critical_gap_near(const Ignites& ignites, double guess, double largest) {
  constexpr double first_step = 1e-5, growth = 2.0;  // m
  double from = std::clamp(guess, 0.0, largest);
  const std::optional<bool> there = ignites(from);
  if (!there) return math::not_a_number;
  // Away from the guess until the state changes.
  for (double step = *there ? -first_step : first_step;; step *= growth) {
    const double to = std::clamp(from + step, 0.0, largest);
    const std::optional<bool> here = ignites(to);
    if (!here) return math::not_a_number;
    if (*here != *there) return *there ? bisect(ignites, to, from) : bisect(ignites, from, to);
    if (to == 0.0) return 0.0;
    if (to == largest) return no_ignition;
    from = to;
  }
}

}  // namespace launchsafe::study
