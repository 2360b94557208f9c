#include "launchsafe/scene/toml_reader.hpp"
#include "posix_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <random>

namespace launchsafe::store {
namespace {

constexpr std::string_view temporary_begin = ".launchsafe.", temporary_end = ".partial";

/// Leaves nothing behind on a failure; false with errno set.
bool write_new(const std::filesystem::path& path, std::string_view content) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) return false;
  if (write_all(file.number(), content) && ::fsync(file.number()) == 0 && file.close()) return true;
  const int error_number = errno;
  ::unlink(path.c_str());
  errno = error_number;
  return false;
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Never over something that is there: then the error is file_exists.
std::error_code move_to_free_name(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return {};
  if (errno != EINVAL && errno != ENOSYS) return last_error();
  // A file system without RENAME_NOREPLACE: a hard link fails on an existing target too.
  if (::link(from.c_str(), to.c_str()) == 0 && ::unlink(from.c_str()) == 0) return {};
  return last_error();
}

std::error_code publish(const std::filesystem::path& from, const std::filesystem::path& to,
                        IfExists if_exists) {
  if (if_exists == IfExists::refuse) return move_to_free_name(from, to);
  return ::rename(from.c_str(), to.c_str()) == 0 ? std::error_code() : last_error();
}

}  // namespace

bool is_temporary(std::string_view name) {
  return name.starts_with(temporary_begin) && name.ends_with(temporary_end);
}

void remove_leftovers(const std::filesystem::path& folder) {
  for (const std::string& name : scene::list_folder(folder))
    if (is_temporary(name)) ::unlink((folder / name).c_str());
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

MaybeError write_file_atomically(const std::filesystem::path& path, std::string_view content,
                                 IfExists if_exists) {
  const std::filesystem::path temporary =
      folder_of(path) / fmt::format("{}{}.{:08x}{}", temporary_begin, path.filename().string(),
                                    std::random_device{}(), temporary_end);
  if (!write_new(temporary, content)) return write_error(path, errno);
  if (const std::error_code error = publish(temporary, path, if_exists)) {
    ::unlink(temporary.c_str());
    if (error == std::errc::file_exists && if_exists == IfExists::refuse)
      return Error{Error::Kind::conflict, fmt::format("{} exists already", path.string())};
    return write_error(path, error.value());
  }
  if (!sync_folder(folder_of(path))) return write_error(path, errno);
  return {};
}

Result<std::string> read_file(const std::filesystem::path& path) {
  auto content = scene::read_regular_file(path, std::numeric_limits<std::size_t>::max());
  if (content) return std::move(*content);
  return Error{content.error().file_missing ? Error::Kind::missing : Error::Kind::unreadable,
               "cannot read " + content.error().message()};
}

std::string system_reason(int error_number) { return std::generic_category().message(error_number); }

Error write_error(const std::filesystem::path& path, int error_number) {
  return {Error::Kind::write_failed,
          fmt::format("cannot write {}: {}", path.string(), system_reason(error_number))};
}

Error of_file(const std::filesystem::path& path, const Error& error) {
  return {error.kind, fmt::format("{}: {}", path.string(), error.message)};
}

Error refusal(const std::filesystem::path& path, std::string_view what) {
  return {Error::Kind::conflict,
          fmt::format("{} {}, and nothing is overwritten; move it away or name another folder", path.string(),
                      what)};
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

}  // namespace launchsafe::store
