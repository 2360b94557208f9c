// Answers to all cases of a study with the fewest mechanical runs: cases that differ in thermal keys alone
// share one, and what is stored is not computed again.
#pragma once

#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <vector>

namespace launchsafe::study {

/// An answer for every case; one that was not run, failed or belongs to another shard says so.
std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing);

/// How far a run came that was cut off depends on the machine, and is no part of the result.
bool was_cut_off(const FinishedRun& run);
/// The answer to a case from its finished runs; a failed one where they have no result or were cut off.
CaseAnswer answer_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);

}  // namespace launchsafe::study
