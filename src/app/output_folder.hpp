// The places that a user names for results.
#pragma once

#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace launchsafe::app {

/// Makes the folder where it does not exist. A message when it cannot be made or written to, so that a run
/// finds out before it computes rather than after.
std::optional<std::string> prepare_output_folder(const std::filesystem::path& folder);

/// Why a file with this content may not be written there: a link, or something with another content. A file
/// that holds the content already is none. Changes nothing.
std::optional<std::string> obstacle_to_file(const std::filesystem::path& file, std::string_view content);

/// Writes a file, unless it is there with this content already; never over anything. `obstacle_to_file` has
/// found nothing.
store::MaybeError write_where_absent(const std::filesystem::path& file, std::string_view content);

}  // namespace launchsafe::app
