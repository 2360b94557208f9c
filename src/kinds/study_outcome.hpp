// The outcome of a study from the result of its kind.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// Adds a run that came to nothing, unless another shard runs it.
inline void add_failure(std::vector<Failure>& failures, const std::string& label, study::RunOutcome outcome,
                        const std::string& reason) {
  if (!reason.empty() && outcome != study::RunOutcome::other_shard)
    failures.push_back({label, reason, outcome});
}

/// Of a kind that has an answer for every case.
template <class Result>
std::vector<Failure> failures_of(const Result& result) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    add_failure(failures, result.study.cases.label(i), result.answers[i].outcome, result.answers[i].failure);
  return failures;
}

/// Whether a verdict or the critical gap of a case is indeterminate.
template <class Answer>
bool is_indeterminate(const Answer& answer) {
  return answer.critical.kind == study::CriticalGapKind::indeterminate ||
         std::ranges::any_of(answer.verdicts, [](const study::GapVerdict& row) {
           return row.judgement.verdict == study::Verdict::indeterminate;
         });
}

/// Kind::run from the function that runs a study of the kind, and the one that says what failed of its
/// result. The report is that of the whole study: a shard and an interrupted study have none.
template <auto run, auto failures>
StudyOutcome outcome_of(const study::StudyFile& study, const study::StudyOptions& options) {
  const auto result = run(study, options);
  StudyOutcome outcome{result.interrupted, false, failures(result), result.timing, {}};
  if constexpr (requires { result.any_indeterminate(); }) outcome.indeterminate = result.any_indeterminate();
  if (!result.interrupted && options.shard.whole()) outcome.report = report_of(result);
  return outcome;
}

}  // namespace launchsafe::kinds
