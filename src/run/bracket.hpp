// Between which two centres of a lattice a place lies.
#pragma once

namespace launchsafe::run {

/// A place between two neighbouring centres of a lattice: the lower index and the share of the upper one.
/// Beyond the first and the last centre, up to half a cell, the share lies outside of 0 to 1: values are
/// continued by the straight line through the two nearest centres, so that they are of second order
/// everywhere.
struct Bracket {
  int lower;
  double share;
};
template <class Centre>
Bracket bracket_of(double place, int count, Centre&& centre) {
  if (count < 2) return {0, 0.0};
  int lower = 0;
  while (lower + 2 < count && centre(lower + 1) <= place) ++lower;
  return {lower, (place - centre(lower)) / (centre(lower + 1) - centre(lower))};
}

}  // namespace launchsafe::run
