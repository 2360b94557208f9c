// The film of air in a gap against closed forms, and the traces that these are known for.
#pragma once

#include "launchsafe/trace/bottom_trace.hpp"
#include "launchsafe/verify/check.hpp"

#include <functional>
#include <vector>

namespace launchsafe::verify {

using FunctionOfTime = std::function<double(double)>;

/// A bottom of one ring without friction under a pressure (Pa) of time (s), whose integral from 0 is known.
trace::BottomTrace pressed_bottom(int intervals, double duration, const FunctionOfTime& pressure,
                                  const FunctionOfTime& integral);

std::vector<Check> film_checks();

}  // namespace launchsafe::verify
