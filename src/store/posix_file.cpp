#include "posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

namespace launchsafe::store {

std::string system_reason(int error_number) { return std::generic_category().message(error_number); }

Error write_error(const std::filesystem::path& path, int error_number) {
  return {Error::Kind::write_failed,
          fmt::format("cannot write {}: {}", path.string(), system_reason(error_number))};
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

bool rename_to_free_name(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;
  // A file system without RENAME_NOREPLACE: a hard link fails on an existing target too.
  return ::link(from.c_str(), to.c_str()) == 0 && ::unlink(from.c_str()) == 0;
}

}  // namespace launchsafe::store
