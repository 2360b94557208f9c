// The one place where whole files are read.
#include "launchsafe/scene/toml_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace launchsafe::scene {
namespace {

constexpr std::string_view allowed_file = "a regular file";

/// A descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

/// The nearest name in the folder of a file that does not exist, in quotation marks; empty for none.
std::string nearest_file(const std::filesystem::path& file) {
  std::error_code failure;
  std::vector<std::string> names;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const std::string near = nearest_of(file.filename().string(), names);
  return near.empty() ? near : '"' + (file.parent_path() / near).string() + '"';
}

/// What a path leads to that is no regular file.
std::string_view kind_of(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) return "a folder";
  if (S_ISFIFO(status.st_mode)) return "a pipe";
  if (S_ISSOCK(status.st_mode)) return "a socket";
  return "a device";
}

InputError unreadable(const Place& place, int reason) {
  const bool missing = reason == ENOENT || reason == ENOTDIR;
  InputError error =
      missing ? error_at(place, {}, {}, {})
              : error_at(place, {}, fmt::format("a file that cannot be read ({})", std::strerror(reason)),
                         "a readable file");
  error.file_missing = missing;
  return error;
}

InputError too_large(const Place& place, std::size_t largest) {
  return error_at(place, {}, fmt::format("a file of more than {} MiB", largest >> 20),
                  fmt::format("a file of at most {} MiB", largest >> 20));
}

}  // namespace

Expected<std::string> read_regular_file(const std::filesystem::path& file, std::size_t largest) {
  const Place place{file.string()};
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return unreadable(place, errno);
  // Before it is opened, because that alone may do something to a device.
  if (!S_ISREG(status.st_mode)) return error_at(place, {}, kind_of(status), allowed_file);
  // Should it have become a pipe by now, opening it does not wait for a writer.
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (descriptor.number() < 0 || ::fstat(descriptor.number(), &status) != 0) return unreadable(place, errno);
  if (!S_ISREG(status.st_mode)) return error_at(place, {}, kind_of(status), allowed_file);
  std::string text;
  text.reserve(std::min(static_cast<std::size_t>(status.st_size), largest));
  std::array<char, std::size_t{1} << 16> part;
  for (;;) {
    const ssize_t count = ::read(descriptor.number(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return unreadable(place, errno);
    if (count == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
    if (text.size() > largest) return too_large(place, largest);
  }
}

Expected<std::string> read_text_file(const std::filesystem::path& file, std::size_t largest) {
  auto text = read_regular_file(file, largest);
  if (text || !text.error().file_missing) return text;
  InputError error = text.error();
  error.suggestion = quotable(nearest_file(file), longest_quoted);
  return error;
}

}  // namespace launchsafe::scene
