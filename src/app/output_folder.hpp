// The folder that a user names for results.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace launchsafe::app {

/// Makes the folder where it does not exist. A message when it cannot be made or written to, so that a run
/// finds out before it computes rather than after.
std::optional<std::string> prepare_output_folder(const std::filesystem::path& folder);

}  // namespace launchsafe::app
