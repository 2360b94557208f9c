// launchsafe verify --finite-elements
#pragma once

#include "commands.hpp"

namespace launchsafe::app {

ExitCode compare_with_finite_elements(const VerifyArguments& arguments, Console& console);

}  // namespace launchsafe::app
