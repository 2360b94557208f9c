// The places that a user names for results.
#pragma once

#include "console.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// Texts of files, each under its name.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// Writes files into a folder, which is made where there is none: all of them, or none where one may not be
/// written, which it says.
ExitCode write_where_absent(const std::filesystem::path& folder, const NamedTexts& texts, Console& console);

/// Why the files of a command's report may not be written into the folder, which is made where there is none.
std::optional<std::string> obstacle_to_report(const std::filesystem::path& folder,
                                              const std::vector<std::string>& names);

/// Writes the texts of a command's report, each under its name. Errors: those of `store::write_own_file`.
store::MaybeError write_texts(const std::filesystem::path& folder, const NamedTexts& texts,
                              report::WrittenFiles& written);

}  // namespace launchsafe::app
