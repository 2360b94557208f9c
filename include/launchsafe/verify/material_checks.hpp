// Numbers of the material laws: air, JWL, virial gas, steel, cracks, kinetics, and the statistics of studies.
#pragma once

#include "launchsafe/verify/check.hpp"

#include <vector>

namespace launchsafe::verify {

std::vector<Check> material_checks();

}  // namespace launchsafe::verify
