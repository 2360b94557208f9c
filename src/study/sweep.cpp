#include "launchsafe/study/sweep.hpp"

#include "answer_cases.hpp"

#include <algorithm>

namespace launchsafe::study {

bool SweepResult::any_failed() const { return detail::any_failed(answers); }

bool SweepResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), [](const CaseAnswer& answer) {
    return answer.critical.kind == CriticalGapKind::indeterminate ||
           std::any_of(answer.verdicts.begin(), answer.verdicts.end(),
                       [](const GapVerdict& row) { return row.judgement.verdict == Verdict::indeterminate; });
  });
}

SweepResult run_sweep(const StudyFile& study, const StudyOptions& options) {
  return detail::run_answering<SweepResult>(study, options, [](SweepResult&) {});
}

}  // namespace launchsafe::study
