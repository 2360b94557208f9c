// Held, degraded, caught or WRONG: the rules for a stress case.
#pragma once

#include "launchsafe/kinds/stability.hpp"

namespace launchsafe::kinds {

/// What is known of one launch.
struct LaunchRecord {
  study::RunOutcome outcome = RunOutcome::ran;
  std::string failure;                    ///< why it was not run at all; then nothing else is known
  std::string reason;                     ///< when and where it was stopped, if it was
  double end_time = study::not_a_number;  ///< s, reached
  double ignition_temperature = study::not_a_number;  ///< K
  study::CaseAnswer answer;
  std::vector<std::string> violations;  ///< of invariants
  std::vector<std::string> validity_warnings;
};

/// The row of a launch. `record` is nullptr for a case of the reader, `against` for one without a safe
/// computation to compare with.
///
/// Caught: the run was stopped, or the reader refused the scene. WRONG: an invariant is violated, or T max is
/// further from the safe computation than its uncertainty, and a verdict says SAFE or UNSAFE. Degraded: the
/// same with an indeterminate verdict; validity warnings, limiters, a temperature that is no number, a stop
/// that came later than it must, or nothing left to compare with. Held: everything else.
StressCaseRow judge_stress_case(const StressCase& launch, const LaunchRecord* record,
                                const LaunchRecord* against);

}  // namespace launchsafe::kinds
