// Files by descriptor: what the standard library's streams cannot say, such as when bytes are on disk.
#pragma once

#include "launchsafe/store/file.hpp"

#include <sys/stat.h>
#include <unistd.h>

namespace launchsafe::store {

/// An open file; closed at the end of its scope.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  /// False with errno set when the close reports a write error.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_ = -1;
};

/// The system's words for an errno value.
std::string system_reason(int error_number);

/// "cannot write PATH: REASON", of kind write_failed.
Error write_error(const std::filesystem::path& path, int error_number);

/// The error, whose message begins with the file.
Error of_file(const std::filesystem::path& path, const Error& error);

/// "PATH WHAT, and nothing is overwritten ...", of kind conflict.
Error refusal(const std::filesystem::path& path, std::string_view what);

/// Writes all of it, however many calls that takes. False with errno set.
bool write_all(int file, std::string_view bytes);

/// So that new names in the folder survive a power cut. False with errno set. Some network file systems
/// cannot sync a folder; theirs is no failure.
bool sync_folder(const std::filesystem::path& folder);

}  // namespace launchsafe::store
