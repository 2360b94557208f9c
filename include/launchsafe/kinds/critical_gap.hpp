// The study of kind critical-gap: which gaps ignite, and from which gap on.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/gap_verdict.hpp"

#include <vector>

namespace launchsafe::kinds {

/// What a study file of this kind says besides.
struct CriticalGapSettings {
  std::vector<double> peak_pressures;  ///< Pa; empty: the scene's
  std::vector<double> crack_radii;     ///< m, c(0); empty: the scene's
  std::vector<double> flaw_sizes;      ///< m, a; empty: the scene's
  bool confirm = true;                 ///< runs with skin on both sides of the bracket
};

struct CriticalGapResult {
  study::StudyFile study;
  std::vector<study::CaseOutcome> cases;  ///< in the order of StudyFile::cases
  study::Timing timing;
  bool interrupted = false;
  bool any_failed() const;         ///< a run failed
  bool any_indeterminate() const;  ///< a verdict or a critical gap is indeterminate
};

/// Runs a study of kind critical-gap. Never throws for a case that fails: its verdicts are indeterminate with
/// the reason, and the others go on. Apart from the timing the result depends on the study alone.
CriticalGapResult run_critical_gap(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The run with skin that confirms a gap (m) of a case: "496 MPa, 30 um, 1 mm, coupled at 0.04 cm". Journals
/// of stored studies name it so.
std::string label_with_skin(const study::CaseOutcome& outcome, double gap);

/// The row of the table of kinds.
Kind critical_gap_kind();

}  // namespace launchsafe::kinds
