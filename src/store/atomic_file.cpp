#include "launchsafe/store/atomic_file.hpp"

#include "posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <random>

namespace launchsafe::store {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  std::random_device random;
  const std::uint64_t number = std::uint64_t{random()} << 32 | random();
  return folder_of(path) / fmt::format(".{}.{:016x}{}", path.filename().string(), number, partial_suffix);
}

/// False with errno set.
bool write_synced(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) return false;
  for (const std::string_view part : parts) {
    if (!write_all(file.number(), part)) return false;
  }
  return ::fsync(file.number()) == 0 && file.close();
}

/// False with errno set; EEXIST when the target exists and must not be replaced.
bool publish(const std::filesystem::path& from, const std::filesystem::path& to, IfExists if_exists) {
  if (if_exists == IfExists::replace) return ::rename(from.c_str(), to.c_str()) == 0;
  return rename_to_free_name(from, to);
}

}  // namespace

MaybeError write_file_atomically(const std::filesystem::path& path,
                                 std::initializer_list<std::string_view> parts, IfExists if_exists) {
  const std::filesystem::path temporary = temporary_name(path);
  if (!write_synced(temporary, parts) || !publish(temporary, path, if_exists)) {
    const int error_number = errno;
    if (error_number != EEXIST || if_exists == IfExists::replace) {
      ::unlink(temporary.c_str());
      return write_error(path, error_number);
    }
    ::unlink(temporary.c_str());
    return Error{Error::Kind::conflict, fmt::format("{} exists already", path.string())};
  }
  if (!sync_folder(folder_of(path))) return write_error(path, errno);
  return {};
}

Result<std::string> read_file(const std::filesystem::path& path) {
  const auto failure = [&path](int error_number) {
    const bool missing = error_number == ENOENT || error_number == ENOTDIR;
    return Error{missing ? Error::Kind::missing : Error::Kind::unreadable,
                 fmt::format("cannot read {}: {}", path.string(), system_reason(error_number))};
  };
  // O_NONBLOCK so that a named pipe is refused below rather than waited for.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) return failure(errno);
  if (S_ISDIR(status.st_mode)) return failure(EISDIR);
  if (!S_ISREG(status.st_mode))
    return Error{Error::Kind::unreadable, path.string() + " is not a regular file"};

  std::string content(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  while (filled < content.size()) {
    const ssize_t taken = ::read(file.number(), content.data() + filled, content.size() - filled);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) return failure(errno);
    if (taken == 0) break;
    filled += static_cast<std::size_t>(taken);
  }
  content.resize(filled);
  return content;
}

}  // namespace launchsafe::store
