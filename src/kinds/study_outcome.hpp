// The outcome of a study from the result of its kind.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <string>
#include <utility>
#include <vector>

namespace launchsafe::kinds {

/// Adds a run that came to nothing, unless another shard runs it.
inline void add_failure(std::vector<Failure>& failures, const std::string& label, study::RunOutcome outcome,
                        const std::string& reason) {
  if (!reason.empty() && outcome != study::RunOutcome::other_shard)
    failures.push_back({label, reason, outcome});
}

/// Of a kind that has an answer for every case.
inline std::vector<Failure> failures_of(const study::StudyFile& study,
                                        const std::vector<study::CaseAnswer>& answers) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < answers.size(); ++i)
    add_failure(failures, study.cases[i].label, answers[i].outcome, answers[i].failure);
  return failures;
}

/// The report is that of the whole study: a shard and an interrupted study have none.
template <class Result>
StudyOutcome outcome_of(const Result& result, const study::StudyOptions& options, bool indeterminate,
                        std::vector<Failure> failures) {
  StudyOutcome outcome{result.interrupted, indeterminate, std::move(failures), result.timing, {}};
  if (!result.interrupted && options.shard.whole()) outcome.report = report_of(result);
  return outcome;
}

}  // namespace launchsafe::kinds
