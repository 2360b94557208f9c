// Numbers of an answer that are fitted or have indices.
#pragma once

#include "launchsafe/study/case_answer.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace launchsafe::kinds {

/// Whether a gap of the study ignites in any case, so that T max jumps to that of a burning skin.
inline bool any_ignites(const std::vector<study::CaseAnswer>& answers, std::size_t gap) {
  return std::ranges::any_of(answers, [gap](const study::CaseAnswer& answer) {
    return answer.verdicts.size() > gap && answer.verdicts[gap].ignition.has_value();
  });
}

/// K, T max at a gap of the study; `inert`: of a skin that does not react. NaN of a case that failed.
inline double temperature_of(const study::CaseAnswer& answer, std::size_t gap, bool inert) {
  if (!answer.completed()) return study::not_a_number;
  return inert ? answer.heated_temperature[gap] : answer.verdicts[gap].maximum.temperature;
}

inline bool is_bound(const study::CaseAnswer& answer) {
  return answer.critical.kind == study::CriticalGapKind::all_safe ||
         answer.critical.kind == study::CriticalGapKind::all_ignite;
}

}  // namespace launchsafe::kinds
