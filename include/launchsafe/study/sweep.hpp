// The study of kind sweep: verdicts and critical gaps over a full factorial of scene keys.
#pragma once

#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/read_study.hpp"

#include <vector>

namespace launchsafe::study {

struct SweepResult {
  StudyFile study;
  std::vector<CaseAnswer> answers;  ///< one for each of StudyFile::cases
  Timing timing;
  bool interrupted = false;
  bool any_failed() const;         ///< a run failed
  bool any_indeterminate() const;  ///< a verdict or a critical gap is indeterminate
};

/// Runs a study of kind sweep. A case's failure is that case's row. Apart from the timing the result depends
/// on the study alone, whatever was stored before.
SweepResult run_sweep(const StudyFile& study, const StudyOptions& options = {});

}  // namespace launchsafe::study
