// launchsafe explain without a scene or study: what the program says of itself, and of materials.
#pragma once

#include "commands.hpp"

namespace launchsafe::app {

/// Prints keys, materials or a schema.
ExitCode explain_program(const ExplainArguments& arguments, Console& console);
/// Prints the materials of a file.
ExitCode explain_material_file(const std::filesystem::path& file, Console& console);

}  // namespace launchsafe::app
