// What the sources of a critical-gap study share.
#pragma once

#include "launchsafe/kinds/critical_gap.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

/// Computed and published temperatures side by side; what the coupled runs came to that confirm critical
/// gaps.
Table comparison_table(const CriticalGapResult& result);
Table coupled_run_table(const CriticalGapResult& result);

/// Adds to the page of a study in detail the causes and the fits; then how its runs went, and what they took.
void add_details(const CriticalGapResult& result, Report& report);
void add_runs(const CriticalGapResult& result, Report& report);
/// What these tables hold.
std::vector<ReportTable> detail_results();
/// What must be said where limiters acted in cases of a study in detail.
std::string limiter_remark(const CriticalGapResult& result);

}  // namespace launchsafe::kinds
