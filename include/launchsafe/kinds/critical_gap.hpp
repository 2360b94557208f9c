// The study of kind critical-gap: which gaps ignite, and from which gap on, in one case or in every
// combination of what varies.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::kinds {

/// What a study file of this kind says besides.
struct CriticalGapSettings {
  bool confirm = true;  ///< coupled runs on both sides of the bracket
};

struct CriticalGapResult : StudyResult {
  std::vector<study::CaseAnswer> answers;  ///< one for each of StudyFile::cases
  /// What else is known of the same cases in a study in detail: histories, coupled runs, other terms.
  std::vector<study::CaseOutcome> details;
  bool any_indeterminate() const;  ///< a verdict or a critical gap is indeterminate
};

/// Runs a study of kind critical-gap. Never throws for a case that fails: its verdicts are indeterminate with
/// the reason, and the others go on. Apart from the timing the result depends on the study alone, whatever
/// was stored before.
CriticalGapResult run_critical_gap(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The answer in a few lines. In detail, of every case: "Critical gap 0.0395 cm ...", a bound, or why there
/// is none; otherwise values and bounds, the smallest critical gap and where it is, verdicts, failures.
std::string answer(const CriticalGapResult& result);
/// Of a study that is not in detail nothing in it differs between two runs: no times, rates, dates or hosts.
report::Report report_of(const CriticalGapResult& result);

/// A row for every gap of every case.
report::Table verdict_table(const CriticalGapResult& result);
/// A row for every case: critical gap and bounds; in detail its confirmation, otherwise its place and run. A
/// bound is text, never a number among values.
report::Table critical_gap_table(const CriticalGapResult& result);
/// Maximum temperature against gap with its uncertainty, the published rows by what they were used for, and
/// of one case the fit and the critical gap with its uncertainty; of a study in detail.
report::Plot temperature_plot(const CriticalGapResult& result);

/// Critical gap over one or two axes that have several values: lines along one, for some values of the other.
std::optional<report::Picture> gap_picture(const CriticalGapResult& result);

}  // namespace launchsafe::kinds
