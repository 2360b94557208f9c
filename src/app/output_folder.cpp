#include "output_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

namespace launchsafe::app {

std::optional<std::string> prepare_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    return fmt::format("--output: found {}, which is no folder and cannot be made one{}; allowed: a folder",
                       folder.string(), error ? " (" + error.message() + ")" : "");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return fmt::format("--output: found {}, which may not be written to; allowed: a folder of yours",
                       folder.string());
  }
  return std::nullopt;
}

}  // namespace launchsafe::app
