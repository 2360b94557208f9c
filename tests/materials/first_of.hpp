// Runs compute the laws on a Pack, studies on a double: tests of both read the first number.
#pragma once

#include "launchsafe/math/pack.hpp"

namespace launchsafe::test_support {

inline double first_of(double number) { return number; }
inline double first_of(const math::Pack& numbers) { return numbers[0]; }

}  // namespace launchsafe::test_support
