// What the tables and the page of a sweep share.
#pragma once

#include "launchsafe/kinds/sweep.hpp"
#include "launchsafe/report/shown_key.hpp"

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

/// What failed and why, at most three by name: "496 MPa, 30 um (energy drift); ...; and 4 more". By label
/// where no keys are given.
std::string failures_list(const std::vector<report::ShownKey>& keys, const study::StudyFile& study,
                          const std::vector<study::CaseAnswer>& answers);

/// What must be said where limiters acted; else empty.
std::string limited_text(const SweepCounts& counts, const std::string& noun);

/// "1 case", "3 cases".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace launchsafe::kinds
