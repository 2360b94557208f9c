// launchsafe explain --materials: the materials that ship, with every number and where it comes from.
#pragma once

#include "console.hpp"

#include <string>

namespace launchsafe::app {

/// Prints the shipped materials whose name begins with a word; all for an empty one.
ExitCode explain_materials(const std::string& word, Console& console);

}  // namespace launchsafe::app
