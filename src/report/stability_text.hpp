// What the tables, the page and the JSON of a stability study share.
#pragma once

#include "launchsafe/study/stability.hpp"

#include <string>

namespace launchsafe::report::detail {

/// "held", "degraded", "caught", "WRONG", or "not computed".
std::string outcome_text(const study::HardRow& row);
/// The finding, or why there is none.
std::string finding_text(const study::HardRow& row);

}  // namespace launchsafe::report::detail
