#include "launchsafe/kinds/sweep.hpp"

#include "launchsafe/study/answer_cases.hpp"
#include "study_outcome.hpp"

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

bool SweepResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), is_indeterminate<CaseAnswer>);
}

SweepResult run_sweep(const StudyFile& study, const StudyOptions& options) {
  return run_answering<SweepResult>(study, options, [](SweepResult&) {});
}

}  // namespace launchsafe::kinds
