// One launch has one uncertainty, whichever study judges it.
#pragma once

#include "launchsafe/report/safety_evidence.hpp"

namespace launchsafe::report {

/// Refuses studies that judge the same launch, with the same numerics, by different lower bounds of its
/// critical gap: they do not rest on the same records or statements. Where numerics or any other key of the
/// scene differs the bounds may. Not compared are critical gaps beyond the end of a search, and a comparison
/// whose result is the record of other models, which it cannot use itself.
store::MaybeError check_agreement(const SafetyEvidence& evidence);

}  // namespace launchsafe::report
