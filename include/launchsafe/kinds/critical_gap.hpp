// The study of kind critical-gap: which gaps ignite, and from which gap on.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/study/gap_verdict.hpp"

#include <string>
#include <vector>

namespace launchsafe::kinds {

/// What a study file of this kind says besides.
struct CriticalGapSettings {
  std::vector<double> peak_pressures;  ///< Pa; empty: the scene's
  std::vector<double> crack_radii;     ///< m, c(0); empty: the scene's
  std::vector<double> flaw_sizes;      ///< m, a; empty: the scene's
  bool confirm = true;                 ///< coupled runs on both sides of the bracket
};

struct CriticalGapResult {
  study::StudyFile study;
  std::vector<study::CaseOutcome> cases;  ///< in the order of StudyFile::cases
  study::Timing timing;
  bool interrupted = false;
  bool any_indeterminate() const;  ///< a verdict or a critical gap is indeterminate
};

/// Runs a study of kind critical-gap. Never throws for a case that fails: its verdicts are indeterminate with
/// the reason, and the others go on. Apart from the timing the result depends on the study alone.
CriticalGapResult run_critical_gap(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The coupled run that confirms a gap (m) of a case: "496 MPa, 30 um, 1 mm, coupled at 0.04 cm". Journals
/// of stored studies name it so.
std::string label_with_skin(const study::CaseOutcome& outcome, double gap);

/// The row of the table of kinds.
Kind critical_gap_kind();

/// The answer in a sentence or two: "Critical gap 0.0395 cm ...", a bound, or why there is none.
std::string answer(const CriticalGapResult& result);

/// A row for every gap of every case: what is printed on stdout.
report::Table verdict_table(const CriticalGapResult& result);
/// Maximum and early temperatures against the published ones; without rows where there are none.
report::Table comparison_table(const CriticalGapResult& result);
/// What makes each critical gap uncertain, cause by cause.
report::Table gap_share_table(const CriticalGapResult& result);
/// What the tables below hold.
std::vector<ResultTable> critical_gap_results();
std::vector<report::Column> as_calibrated_columns();
/// What the skin of every gap does with its foreign constants as calibrated; no rows where it has none.
report::Table as_calibrated_table(const CriticalGapResult& result);
/// Critical gap of every case, with bracket and confirmation.
report::Table critical_gap_table(const CriticalGapResult& result);
/// The study's cited limits beside the critical gaps of its cases; without rows where it cites none.
report::Table cited_limit_table(const CriticalGapResult& result);
/// What the complete coupled runs came to that confirm critical gaps.
report::Table coupled_run_table(const CriticalGapResult& result);
/// Highest temperatures and critical gaps under the reservoir and under the film of air, by name; no rows
/// where the study's own air is no reservoir.
report::Table air_model_table(const CriticalGapResult& result);
/// Highest temperatures and critical gaps with and without the muzzle exit; no rows where there is none.
report::Table without_exit_table(const CriticalGapResult& result);
/// What the skin took from the air of every gap of every case, and what follows from it.
report::Table air_energy_table(const CriticalGapResult& result);
/// Lines of one case and their residuals.
report::Table fit_table(const study::CaseOutcome& outcome);
/// Status, energy drift, limiters and speed of every run.
report::Table run_table(const CriticalGapResult& result);

/// Maximum temperature against gap with its uncertainty, the published rows by what they were used for, and
/// of one case the fit and the critical gap with its uncertainty.
report::Plot temperature_plot(const CriticalGapResult& result);
/// The critical gaps of several cases below each other, with their uncertainty; bounds as bounds.
report::Plot critical_gaps_plot(const CriticalGapResult& result);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const CriticalGapResult& result);

}  // namespace launchsafe::kinds
