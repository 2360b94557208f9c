// The words of verdicts: what evidence and judgements say, for people. They are made where they are shown,
// and never read back.
#pragma once

#include "launchsafe/study/verdict.hpp"

#include <string>

namespace launchsafe::study {

// Clauses of a reason; each is empty where there is nothing to say.

/// Why a run is no basis, and what becomes of a gap when a launch that is cut short goes on until it is over.
std::string validity_warnings_text(const Evidence& evidence);
/// What of the input is not plausible, or foreign to the calibration, and not accepted.
std::string unaccepted_text(const CaseStatements& input);
/// What is not plausible, or foreign, and why it is meant.
std::string accepted_text(const CaseStatements& input);
/// Why no ignition shows nothing.
std::string to_string(const Optimistic& optimistic);
/// Limiters that acted.
std::string limiters_text(const Evidence& evidence);
/// What the noise of a measured curve counts.
std::string noise_text(const Evidence& evidence);
/// Models that could change the verdict.
std::string models_text(const Evidence& evidence);
/// What lies outside the calibration's domain.
std::string extrapolated_text(const Evidence& evidence);

/// What the rule says that gave the verdict.
std::string cause_text(const Evidence& evidence, const Judgement& judgement);
/// Why a verdict is what it is: the cause, and all that stands beside it.
std::string reason_text(const Evidence& evidence, const Judgement& judgement);

}  // namespace launchsafe::study
