// The program's commands in the forms that an installation needs: a manual page, and completion in a shell.
#pragma once

#include "command_line.hpp"

#include <string>

namespace launchsafe::app {

/// The manual page, in the macros of man(7).
std::string manual_page(const CommandDescription& program, const std::string& version);
/// A script for bash that completes commands, options and files of the program.
std::string bash_completion(const CommandDescription& program);

}  // namespace launchsafe::app
