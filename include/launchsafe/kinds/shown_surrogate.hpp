// How an output of a fit is called.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/study/surrogate.hpp"

namespace launchsafe::kinds {

/// "T max at a gap of 0.2 mm, without reaction" in K, or "critical gap" in cm.
report::Column shown(const study::SurrogateOutput& output);

}  // namespace launchsafe::kinds
