// The width of a terminal.
#pragma once

#include <cstddef>
#include <optional>

namespace launchsafe::app {

/// Columns of the terminal that a descriptor leads to; nothing where it leads to none, or to one that does
/// not tell.
std::optional<std::size_t> terminal_width(int descriptor);

}  // namespace launchsafe::app
