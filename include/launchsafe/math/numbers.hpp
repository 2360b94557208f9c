// What no number is, and what none reaches.
#pragma once

#include <limits>

namespace launchsafe::math {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace launchsafe::math
