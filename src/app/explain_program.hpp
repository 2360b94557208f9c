// launchsafe explain without a scene or study: what the program says of itself.
#pragma once

#include "commands.hpp"
#include "console.hpp"

namespace launchsafe::app {

/// Whether nothing is asked of a scene or a study.
bool explains_program(const ExplainArguments& arguments);
/// Prints keys, materials or a schema.
ExitCode explain_program(const ExplainArguments& arguments, Console& console);

}  // namespace launchsafe::app
