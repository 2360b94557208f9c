#include "launchsafe/kinds/sweep.hpp"

#include "launchsafe/study/answer_cases.hpp"

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

bool SweepResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), [](const CaseAnswer& answer) {
    return answer.critical.kind == CriticalGapKind::indeterminate ||
           std::any_of(answer.verdicts.begin(), answer.verdicts.end(),
                       [](const GapVerdict& row) { return row.judgement.verdict == Verdict::indeterminate; });
  });
}

SweepResult run_sweep(const StudyFile& study, const StudyOptions& options) {
  return run_answering<SweepResult>(study, options, [](SweepResult&) {});
}

}  // namespace launchsafe::kinds
