// The study of kind critical-gap: which gaps ignite, and from which gap on, in one case or in every
// combination of what varies.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_rows.hpp"

namespace launchsafe::kinds {

/// What a study file of this kind says besides.
struct CriticalGapSettings {
  bool confirm = true;  ///< coupled runs on both sides of the critical gap
};

struct CriticalGapResult : StudyResult {
  std::vector<study::CaseRow> rows;          ///< one for each of StudyFile::cases
  std::vector<study::CaseInDetail> details;  ///< the same cases with their histories, in a study in detail
};

/// Coupled runs confirm a critical gap this far on both sides of it, m.
inline constexpr double confirm_distance = 1e-6;

/// Runs a study of kind critical-gap. Never throws for a case that fails: its verdicts are indeterminate with
/// the reason, and the others go on. Apart from the timing the result depends on the study alone, whatever
/// was stored before.
CriticalGapResult run_critical_gap(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The answer in a few lines. In detail, for every case: its critical gap with bounds, or why there is none,
/// and the largest SAFE gap; otherwise values and bounds, the smallest critical gap and where it is,
/// verdicts, failures.
std::string answer(const CriticalGapResult& result);
/// Of a study that is not in detail nothing in it differs between two runs: no times, rates, dates or hosts.
report::Report report_of(const CriticalGapResult& result);

/// A row for every gap of every case.
report::Table verdict_table(const CriticalGapResult& result);
/// A row for every case: critical gap and bounds. Where the search found no critical gap its end is text,
/// never a number among values.
report::Table critical_gap_table(const CriticalGapResult& result);
/// Maximum temperature against gap with its uncertainty, the published rows by what they were used for, and
/// of one case the fit and the critical gap with its uncertainty; of a study in detail.
report::Plot temperature_plot(const CriticalGapResult& result);

/// Critical gap over one or two axes that have several values: lines along one, for some values of the other.
std::optional<report::Picture> gap_picture(const CriticalGapResult& result);

}  // namespace launchsafe::kinds
