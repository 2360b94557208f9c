// The signals that a command-line program meets, and the one flag that they set.
#pragma once

#include <atomic>

namespace launchsafe::app {

/// From here on the first SIGINT, SIGTERM or SIGHUP sets the flag of `stop_requested`, and a second one ends
/// the program at once (files are whole or not there, so that is safe). Writing to a closed pipe or past a
/// file-size limit becomes an error of the write instead of the program's end.
void catch_signals();

/// True once the user wants the program to end. Whoever finds that nothing useful can follow may set it too.
std::atomic<bool>& stop_requested();

}  // namespace launchsafe::app
