#include "posix_file.hpp"

#include "launchsafe/store/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

namespace launchsafe::store {

std::string system_reason(int error_number) { return std::generic_category().message(error_number); }

Error write_error(const std::filesystem::path& path, int error_number) {
  return {Error::Kind::write_failed,
          fmt::format("cannot write {}: {}", path.string(), system_reason(error_number))};
}

Error refusal(const std::filesystem::path& path, std::string_view what) {
  return {Error::Kind::conflict,
          fmt::format("{} {}, and nothing is overwritten; move it away or name another folder", path.string(),
                      what)};
}

namespace {

constexpr std::string_view no_plain_file = "is no plain file";
constexpr std::string_view several_names =
    "has several names (hard links), and writing under one would change the other";

/// What keeps a file of this status from being written in place; empty for nothing.
std::string_view fault_of(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return no_plain_file;
  return status.st_nlink > 1 ? several_names : std::string_view{};
}

}  // namespace

MaybeError obstacle_in_place(const std::filesystem::path& path,
                             const std::function<bool(std::string_view content)>& is_ours) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return {};
  if (const std::string_view fault = fault_of(status); !fault.empty()) return refusal(path, fault);
  if (!is_ours) return {};
  const Result<std::string> content = read_file(path);
  if (!content) return content.error();
  if (content->empty() || is_ours(*content)) return {};
  return refusal(path, foreign_file);
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    if (written == 0) {
      errno = ENOSPC;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return descriptor.is_open() && (::fsync(descriptor.number()) == 0 || errno == EINVAL || errno == ENOTSUP);
}

std::vector<std::string> list_folder(const std::filesystem::path& folder, std::error_code& status) {
  std::vector<std::string> found;
  for (std::filesystem::directory_iterator entry(folder, status), end; !status && entry != end;
       entry.increment(status))
    found.push_back(entry->path().filename());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace launchsafe::store
