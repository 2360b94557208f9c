// The verdict of a row, from the numbers of the row: the same whether they were computed or read.
#pragma once

#include "launchsafe/study/gap_verdict.hpp"

#include <string>

namespace launchsafe::study {

/// What a row and its run say; `validity_warnings`, `accepted` and `extrapolated` are left empty. `failure`
/// is empty for a completed run.
Evidence evidence_of(const GapVerdict& row, const std::string& failure, const run::LimiterCounts& limiters);

/// Judges the row on its evidence and keeps both in it.
void judge_row(Evidence evidence, const CriticalGap& critical, GapVerdict& row);

}  // namespace launchsafe::study
