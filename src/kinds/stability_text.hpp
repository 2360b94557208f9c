// What the tables and the page of a stability study share.
#pragma once

#include "launchsafe/kinds/stability.hpp"

#include <string>

namespace launchsafe::kinds {

/// "held", "degraded", "caught", "WRONG", or "not computed".
std::string outcome_text(const StressCaseRow& row);
/// The finding, or why there is none.
std::string finding_text(const StressCaseRow& row);

}  // namespace launchsafe::kinds
