// What the forms of `launchsafe verify` share.
#pragma once

#include "commands.hpp"
#include "progress.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::app {

/// `launchsafe verify --error-against-time`.
ExitCode tabulate_errors(const VerifyArguments& arguments, Console& console);

/// Whether the name has the filter in it, case ignored.
bool has_in_its_name(std::string_view name, std::string_view filter);

/// The end of a command whose filter no check has in its name; the groups are named once each.
ExitCode refuse_filter(const std::string& filter, const std::vector<std::string>& groups, Console& console);

/// Calls `compute` in a thread of its own. Ends the program where the user wants it to stop; `lost` names
/// what was then not printed: "check".
void compute_unless_stopped(Console& console, const char* lost,
                            const std::function<void(Progress&)>& compute);

/// The command that makes a form's result again, on any machine; `form`: "--error-against-time".
std::string verify_command(const char* form, const VerifyArguments& arguments);

}  // namespace launchsafe::app
