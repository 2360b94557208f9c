// Limits of the gap that others found, beside the critical gaps of a study.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

struct StudyFile;
struct CriticalGap;

/// A limit of the gap as cited: a [[cited_limit]].
struct CitedLimit {
  double gap = std::numeric_limits<double>::quiet_NaN();            ///< m, > 0
  double peak_pressure = std::numeric_limits<double>::quiet_NaN();  ///< Pa; NaN where none was stated
  std::string source;                                               ///< who found what, and how
};

/// A cited limit and the case of a study that stands nearest to it.
struct LimitComparison {
  CitedLimit limit;
  /// Among the cases whose peak pressure is nearest to the limit's (or, where it has none, to that of the
  /// study's scene), those with the scene's own defect if there are any: the one with the smallest critical
  /// gap that is a value, or else the first. Nothing for a study without cases.
  std::optional<std::size_t> nearest;
  std::size_t cases = 0;  ///< among which that was chosen
  /// m, its critical gap minus the limit; NaN where the critical gap is no value or the peak pressures differ
  /// by more than pressure_slack
  double difference = std::numeric_limits<double>::quiet_NaN();
};

/// Share of a peak pressure by which a case may differ from a limit that is cited at "about" a pressure.
inline constexpr double pressure_slack = 0.01;

/// Every cited limit of the study against the critical gaps of its cases, in their order.
std::vector<LimitComparison> compare_with_limits(const StudyFile& study,
                                                 const std::vector<const CriticalGap*>& critical);

}  // namespace launchsafe::study
