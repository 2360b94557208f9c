#include "launchsafe/store/file.hpp"

#include "launchsafe/scene/toml_reader.hpp"

#include <fcntl.h>
#include <openssl/sha.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <random>

namespace launchsafe::store {
namespace {

constexpr std::string_view temporary_begin = ".launchsafe.", temporary_end = ".partial";

/// False with errno set.
bool write_new(const std::filesystem::path& path, std::string_view content) {
  std::FILE* file = std::fopen(path.c_str(), "wxe");
  if (file == nullptr) return false;
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
                       std::fflush(file) == 0 && ::fsync(::fileno(file)) == 0;
  const int reason = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = reason;
  return written && closed;
}

/// So that new names in the folder survive a power cut. False with errno set. Some network file systems
/// cannot sync a folder; theirs is no failure.
bool sync_folder(const std::filesystem::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = opened >= 0 && (::fsync(opened) == 0 || errno == EINVAL || errno == ENOTSUP);
  if (opened >= 0) ::close(opened);
  return synced;
}

}  // namespace

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

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

void write_file_atomically(const std::filesystem::path& path, std::string_view content, IfExists if_exists) {
  const std::filesystem::path temporary =
      folder_of(path) / fmt::format("{}{}.{:08x}{}", temporary_begin, path.filename().string(),
                                    std::random_device{}(), temporary_end);
  // A second name, unlike a new one, is never given over a file that is there.
  const auto publish = if_exists == IfExists::refuse ? ::link : ::rename;
  const bool is_done = write_new(temporary, content) && publish(temporary.c_str(), path.c_str()) == 0;
  const int reason = errno;
  if (!is_done || if_exists == IfExists::refuse) ::unlink(temporary.c_str());
  if (!is_done && reason == EEXIST)
    throw Error{Error::Kind::conflict, fmt::format("{} exists already", path.string())};
  if (!is_done) throw write_error(path, reason);
  if (!sync_folder(folder_of(path))) throw write_error(path, errno);
}

std::string read_file(const std::filesystem::path& path) {
  try {
    return scene::read_text_file(path, std::numeric_limits<std::size_t>::max());
  } catch (const scene::InputError& error) {
    throw Error{error.file_missing ? Error::Kind::missing : Error::Kind::unreadable,
                "cannot read " + error.message()};
  }
}

Error write_error(const std::filesystem::path& path, int error_number) {
  return {Error::Kind::write_failed,
          fmt::format("cannot write {}: {}", path.string(), std::generic_category().message(error_number))};
}

Error refusal(const std::filesystem::path& path, std::string_view what) {
  return {Error::Kind::conflict,
          fmt::format("{} {}, and nothing is overwritten; move it away or name another folder", path.string(),
                      what)};
}

}  // namespace launchsafe::store
