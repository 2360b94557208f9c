// The study of kind sweep: verdicts and critical gaps over a full factorial of scene keys.
#pragma once

#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/model_form.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/read_study.hpp"

#include <optional>
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

/// The critical gaps of a sweep over the peak pressure alone; nothing of another sweep or an interrupted one.
std::optional<CriticalGapCurve> critical_gap_curve(const SweepResult& result);

}  // namespace launchsafe::study
