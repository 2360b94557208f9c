#include "launchsafe/study/sweep.hpp"

#include "answer_cases.hpp"
#include "case_runs.hpp"

#include <algorithm>
#include <chrono>

namespace launchsafe::study {

bool is_indeterminate(const CaseAnswer& answer) {
  return answer.critical.kind == CriticalGapKind::indeterminate ||
         std::any_of(answer.verdicts.begin(), answer.verdicts.end(),
                     [](const GapVerdict& row) { return row.judgement.verdict == Verdict::indeterminate; });
}

bool SweepResult::any_failed() const {
  return std::any_of(answers.begin(), answers.end(), [](const auto& each) { return !each.completed(); });
}

bool SweepResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), is_indeterminate);
}

SweepResult run_sweep(const StudyFile& study, const StudyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  SweepResult result;
  result.study = study;
  result.timing.jobs = detail::jobs_of(options);
  result.answers = detail::answer_cases(study, options, result.timing);
  result.interrupted = detail::stop_requested(options);
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace launchsafe::study
