// The study of kind sweep: verdicts and critical gaps over a full factorial of scene keys.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

#include <vector>

namespace launchsafe::kinds {

struct SweepResult {
  study::StudyFile study;
  std::vector<study::CaseAnswer> answers;  ///< one for each of StudyFile::cases
  study::Timing timing;
  bool interrupted = false;
  bool any_failed() const;         ///< a run failed
  bool any_indeterminate() const;  ///< a verdict or a critical gap is indeterminate
};

/// Runs a study of kind sweep. A case's failure is that case's row. Apart from the timing the result depends
/// on the study alone, whatever was stored before.
SweepResult run_sweep(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The row of the table of kinds.
Kind sweep_kind();

}  // namespace launchsafe::kinds
