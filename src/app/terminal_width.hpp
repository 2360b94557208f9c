// The width of a terminal.
#pragma once

#include <cstddef>
#include <optional>

namespace launchsafe::app {

/// Columns of the terminal that a descriptor leads to; nothing where it leads to none, or to one that does
/// not tell.
std::optional<std::size_t> terminal_width(int descriptor);
/// Those of standard output; 0, for any width, where it is no terminal.
std::size_t width_of_output();

}  // namespace launchsafe::app
