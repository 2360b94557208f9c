// launchsafe explain of materials: every number and where it comes from.
#pragma once

#include "console.hpp"

#include <filesystem>
#include <string>

namespace launchsafe::app {

/// Prints the shipped materials whose name begins with a word; all for an empty one.
ExitCode explain_materials(const std::string& word, Console& console);
/// Prints the materials of a file.
ExitCode explain_material_file(const std::filesystem::path& file, Console& console);

}  // namespace launchsafe::app
