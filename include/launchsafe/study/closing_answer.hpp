// What gaps that close came to, on one bound of what is not known.
#pragma once

#include "launchsafe/study/cases.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// A gap on the terms of a bound.
struct ClosingPoint {
  double gap = 0;                             ///< m
  double maximum_temperature = not_a_number;  ///< K, at any depth and station; NaN where a run has none
  bool ignited = false;
  std::string place;                ///< station of the maximum
  double release = 0;               ///< s, of the terms on which that is
  std::string unknown_for = {};     ///< why there is no temperature; empty where there is one
  std::vector<std::string> hashes;  ///< of the runs
};

/// What a bound says: the points that were computed, by gap, and the smallest gap of them that ignites.
struct ClosingAnswer {
  std::string name;
  std::vector<ClosingPoint> points;
  /// m, between the largest below which nothing ignites (NaN: there is none) and the smallest that does
  /// (infinite: none up to the end of the search; NaN: a temperature beyond `lower` is not known).
  double lower = not_a_number, upper = not_a_number;
  const ClosingPoint* at(double gap) const;
  bool is_worst_corner() const { return name == "corner"; }
};

}  // namespace launchsafe::study
