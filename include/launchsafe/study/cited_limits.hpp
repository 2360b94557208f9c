// Limits of the gap that others found, [[cited_limit]], beside the critical gaps of a study.
#pragma once

#include "launchsafe/study/bracket.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace launchsafe::study {

const std::vector<scene::Key<CitedLimit>>& cited_limit_keys();

/// Reads [[cited_limit]] into Study::cited_limits.
Fault read_cited_limits(const toml::table& root, StudyFile& study);

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
  double difference = not_a_number;
};

/// Share of a peak pressure by which a case may differ from a limit that is cited at "about" a pressure.
inline constexpr double pressure_slack = 0.01;

/// Every cited limit of the study against the critical gaps of its cases, in their order.
std::vector<LimitComparison> compare_with_limits(const StudyFile& study,
                                                 const std::vector<const CriticalGap*>& critical);

}  // namespace launchsafe::study
