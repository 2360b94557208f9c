// Answers in a results file, one row a case, rows of its gaps and of its shares. Verdicts are not stored:
// they follow from what is.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <optional>
#include <string>

namespace launchsafe::study {

/// Stores an answer in the place of one with the same key, which are hexadecimal digits.
void save_answer(store::CaseStore& store, const std::string& key, const CaseAnswer& answer);
store::MaybeError save_answer(store::Database& database, const std::string& key, const CaseAnswer& answer);

/// Exactly what was saved, its rows not judged; not finite numbers but infinity become NaN. Nothing where
/// there is none, and for what was not written by this program as it is: another checksum, an unknown
/// enumerator, a negative amount, numbers that contradict each other.
std::optional<CaseAnswer> read_answer(const store::CaseStore& store, const std::string& key);
std::optional<CaseAnswer> read_answer(store::Database& database, const std::string& key);

/// All that is stored of an answer.
std::string bytes_of(const CaseAnswer& answer);

}  // namespace launchsafe::study
