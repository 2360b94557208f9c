// Whether a result that was read can have come from a run.
#pragma once

#include "launchsafe/run/case_result.hpp"

#include <string>

namespace launchsafe::store {

/// What contradicts itself in a result: times that do not increase, histories of a completed run that are cut
/// short or hold what is no number, places that are not there. Empty for nothing. That a result says what a
/// run came to is what its checksum is for.
std::string fault_in(const run::CaseResult& result);

}  // namespace launchsafe::store
