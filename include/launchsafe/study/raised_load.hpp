// The launch of a case under the load at the hot end of its assumed spread: one of its own, or, in a sweep
// over the peak pressure that asks for it, interpolated between the launches of its neighbours.
#pragma once

#include "launchsafe/study/run_cases.hpp"

namespace launchsafe::study {

/// Whether the uncertainty of the inputs is found by propagating the assumed spread, which takes a run with a
/// raised load beside every case: where verdicts are given and the study states none.
bool propagates_spread(const Study& study);

/// The same launch with the pressure at the hot end of the assumed spread.
scene::Scene with_raised_load(const scene::Scene& scene);
/// "CASE, load +4 %".
std::string label_of_raised(const StudyCase& input);

/// The factors by which neighbouring peak pressures must differ at the least, so that the raised load lies
/// all but between them, and at the most.
inline constexpr double least_load_ratio = 1.036, largest_load_ratio = 1.12;

/// Two cases of a sweep that differ from a third in the peak pressure alone.
struct NeighbouringLoads {
  std::size_t above = 0, beside = 0;  ///< places among the study's cases; `beside` is lower, or above `above`
  double own_peak = 0, above_peak = 0, beside_peak = 0;  ///< Pa
};

/// Of a case whose raised load is to be interpolated and has two neighbours near enough; nothing of others.
std::optional<NeighbouringLoads> neighbouring_loads(const StudyFile& study, std::size_t index);

/// Of the launches of a case and of its two neighbours, which follow it, makes those of the case and of its
/// raised load: linear in the peak pressure between the case and the one above, and hotter by what the same
/// estimate misses the middle one of the three by (trace::at_load). Where a neighbour's launch broke off, so
/// has this one; without a result where it has none.
void interpolate_raised_load(const NeighbouringLoads& loads, std::vector<FinishedRun>& runs);

}  // namespace launchsafe::study
