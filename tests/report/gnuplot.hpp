// Whether pictures can be drawn here.
#pragma once

#include <cstdlib>

namespace launchsafe::report {

inline bool gnuplot_is_there() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

}  // namespace launchsafe::report
