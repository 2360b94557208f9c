// The places that a user names for results.
#pragma once

#include "console.hpp"
#include "launchsafe/report/report.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::app {

/// Makes the folder where it does not exist. A message when it cannot be made or written to, so that a run
/// finds out before it computes rather than after.
std::optional<std::string> prepare_output_folder(const std::filesystem::path& folder);

using NamedTexts = std::vector<report::TextFile>;

/// Where files of these names lie in a folder, as the user named it.
std::vector<std::string> places_of(const std::filesystem::path& folder, const NamedTexts& texts);

/// Writes files into a folder, which is made where there is none: all of them, or none where one may not be
/// written, which it says.
ExitCode write_where_absent(const std::filesystem::path& folder, const NamedTexts& texts, Console& console);

}  // namespace launchsafe::app
