// How long gnuplot may take.
#pragma once

#include "launchsafe/store/program.hpp"

namespace launchsafe::report {

/// What ends a program that draws a picture. A report is whole without its pictures: one that is not drawn is
/// a remark.
using DrawingLimits = store::ProgramLimits;

}  // namespace launchsafe::report
