// Numbers of the heated skin at the charge bottom: exact solutions of its equation, induction times,
// conservation.
#pragma once

#include "launchsafe/verify/check.hpp"

#include <vector>

namespace launchsafe::verify {

std::vector<Check> surface_checks();

}  // namespace launchsafe::verify
