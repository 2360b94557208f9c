#include "output_folder.hpp"

#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

namespace launchsafe::app {

std::optional<std::string> prepare_output_folder(const std::filesystem::path& folder) {
  std::error_code error, unknown;  // a name that is too long, say
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, unknown)) {
    return fmt::format("{} is no folder and cannot be made one{}; allowed: a folder", folder.string(),
                       error ? " (" + error.message() + ")" : "");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return fmt::format("{} may not be written to; allowed: a folder of yours", folder.string());
  }
  return std::nullopt;
}

namespace {

/// Why a file with this content may not be written there: a link, or something with another content. A file
/// that holds the content already is none.
std::optional<std::string> obstacle_to_file(const std::filesystem::path& file, std::string_view content) {
  std::error_code unknown;  // a name that is too long, say: reading it tells
  if (std::filesystem::is_symlink(file, unknown))
    return fmt::format("{} is a link, and nothing is written through one; move it away", file.string());
  const auto present = store::read_file(file);
  if (present && *present == content) return std::nullopt;
  if (!present && present.error().kind == store::Error::Kind::missing) return std::nullopt;
  if (!present) return present.error().message;
  return fmt::format(
      "{} is there with another content, and nothing is overwritten; move it away or name another place",
      file.string());
}

}  // namespace

ExitCode write_where_absent(const std::filesystem::path& folder, const NamedTexts& texts, Console& console) {
  if (const auto obstacle = prepare_output_folder(folder)) return console.refuse(*obstacle);
  for (const auto& [name, text] : texts)
    if (const auto obstacle = obstacle_to_file(folder / name, text)) return console.refuse(*obstacle);
  for (const auto& [name, text] : texts) {
    if (std::filesystem::exists(folder / name)) continue;  // with this content
    if (const auto error = store::write_file_atomically(folder / name, text, store::IfExists::refuse))
      return console.end_with(*error);
  }
  return ExitCode::done;
}

std::vector<std::string> places_of(const std::filesystem::path& folder, const NamedTexts& texts) {
  std::vector<std::string> places;
  for (const report::TextFile& each : texts) places.push_back((folder / each.name).string());
  return places;
}

}  // namespace launchsafe::app
