// Commands that a person can copy into a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::app {

/// The word as a POSIX shell reads it back: in quotes where it needs them.
std::string shell_quoted(std::string_view word);

/// The words with a blank between them, each quoted where needed.
std::string shell_command(const std::vector<std::string>& words);

}  // namespace launchsafe::app
