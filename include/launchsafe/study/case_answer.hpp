// What a study wants to know of one case: all that tables need, and no histories. Answers to all cases take
// the fewest mechanical runs: cases that differ in thermal keys alone share one, and what is stored is not
// computed again. A results file has a row a case; verdicts follow from what is stored.
#pragma once

#include "launchsafe/study/gap_verdict.hpp"
#include "launchsafe/study/run_cases.hpp"

namespace launchsafe::study {

/// The answer to a case that was concluded: all of it but its histories.
CaseAnswer answer_of(const CaseOutcome& outcome);

/// Draws the answer from a mechanical run. `raised`: the mechanics under a raised load, where the study
/// states no uncertainty of the inputs.
CaseAnswer answer_of(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics,
                     const std::optional<run::MechanicsResult>& raised = std::nullopt);
/// Takes in what gaps that close say of the case, and judges its gaps anew.
void take_closing(const StudyCase& input, std::vector<ClosingAnswer> closing, CaseAnswer& answer);
/// The answer of a case without a result.
CaseAnswer failed_answer(const Study& study, const StudyCase& input, RunOutcome outcome, std::string failure);

/// An answer that was read with its verdicts, which are not stored; nothing where it cannot be that of the
/// study's case: by its gaps, margins and times, or by less uncertainty or fewer validity warnings than its
/// input has.
std::optional<CaseAnswer> judged(CaseAnswer answer, const Study& study, const StudyCase& input);

/// An answer for every case; one that was not run, failed or belongs to another shard says so.
std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing);

/// How far a run came that was cut off depends on the machine, and is no part of the result.
bool was_cut_off(const FinishedRun& run);
/// The answer to a case from its finished runs; a failed one where they have no result or were cut off.
CaseAnswer answer_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);

/// Stores an answer in the place of one with the same key, which are hexadecimal digits.
void save_answer(store::CaseStore& store, const std::string& key, const CaseAnswer& answer);
store::MaybeError save_answer(store::Database& database, const std::string& key, const CaseAnswer& answer);

/// Exactly what was saved, its rows not judged; not finite numbers but infinity become NaN. Nothing where
/// there is none, and for what was not written by this program as it is: another checksum, an unknown
/// enumerator, a negative amount, numbers that contradict each other.
std::optional<CaseAnswer> read_answer(const store::CaseStore& store, const std::string& key);
std::optional<CaseAnswer> read_answer(store::Database& database, const std::string& key);

/// All that is stored of an answer.
std::string bytes_of(CaseAnswer answer);

}  // namespace launchsafe::study
