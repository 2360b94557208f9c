// What the tables and pages of studies share that answer all their cases.
#pragma once

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// How many cases and verdicts came out how.
struct SweepCounts {
  std::size_t cases = 0, failed = 0;
  std::map<study::CriticalGapKind, std::size_t> critical_gaps{{study::CriticalGapKind::value, 0},
                                                              {study::CriticalGapKind::all_safe, 0},
                                                              {study::CriticalGapKind::all_ignite, 0},
                                                              {study::CriticalGapKind::several_crossings, 0},
                                                              {study::CriticalGapKind::indeterminate, 0}};
  std::map<study::Verdict, std::size_t> verdicts{
      {study::Verdict::safe, 0}, {study::Verdict::unsafe, 0}, {study::Verdict::indeterminate, 0}};
  std::size_t limited = 0;      ///< cases in which a limiter acted
  run::LimiterCounts limiters;  ///< of all cases
};
SweepCounts counts_of(const std::vector<study::CaseAnswer>& answers);

/// "completed", how the run ended instead, or "failed" where it never was.
std::string status_of(const study::CaseAnswer& answer);

/// Where a case lies, or its label if it has no coordinates.
std::string name_of(const std::vector<report::ShownKey>& keys, const study::StudyCase& input);

/// What failed and why, at most three by name: "496 MPa, 30 µm (energy drift); ...; and 4 more". By label
/// where no keys are given.
std::string failures_list(const std::vector<report::ShownKey>& keys, const study::StudyFile& study,
                          const std::vector<study::CaseAnswer>& answers);

/// What must be said where limiters acted; else empty.
std::string limited_text(const SweepCounts& counts, const std::string& noun);

using report::counted;

/// The lines of an answer below each other, and what every answer about verdicts must say; empty ones are
/// left out.
std::string answer_of(std::vector<std::string> lines, const study::StudyFile& study);

/// A case with its answer, and where it lies.
struct AnsweredCase {
  const study::StudyFile* study;
  std::size_t index;
  const study::CaseAnswer* answer;
  const std::vector<double>& coordinates() const { return study->cases.coordinates(index); }
  const std::string& label() const { return study->cases.label(index); }
  study::StudyCase input() const { return study->cases[index]; }
};
std::vector<AnsweredCase> answered(const study::StudyFile& study,
                                   const std::vector<study::CaseAnswer>& answers);
report::Quantities<AnsweredCase> answered_axes(const study::Study& study);

/// Columns of a matrix on the page.
inline constexpr std::size_t most_gaps = 30;
/// What the matrix calls INDET.
inline constexpr const char* indeterminate_note = "INDET.: indeterminate; verdicts.csv has the reasons.";

}  // namespace launchsafe::kinds
