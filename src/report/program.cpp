#include "program.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace launchsafe::report {
namespace {

/// A nameless file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : number_(::memfd_create(name, MFD_CLOEXEC)) {}
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() {
    if (number_ >= 0) ::close(number_);
  }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

  bool fill(const std::string& content) {
    std::size_t written = 0;
    while (written < content.size()) {
      const ssize_t part = ::write(number_, content.data() + written, content.size() - written);
      if (part < 0 && errno == EINTR) continue;
      if (part <= 0) return false;
      written += static_cast<std::size_t>(part);
    }
    return ::lseek(number_, 0, SEEK_SET) == 0;
  }

  std::string content() const {
    std::string content;
    std::array<char, 1 << 16> part{};
    for (;;) {
      const ssize_t taken = ::pread(number_, part.data(), part.size(), static_cast<off_t>(content.size()));
      if (taken < 0 && errno == EINTR) continue;
      if (taken <= 0) return content;
      content.append(part.data(), static_cast<std::size_t>(taken));
    }
  }

 private:
  int number_;
};

/// The process id, or the negative error number.
pid_t start(const std::string& program, const std::vector<std::string>& arguments, const MemoryFile& input,
            const MemoryFile& output, const MemoryFile& errors) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input.number(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output.number(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors.number(), STDERR_FILENO);
  // In a group of its own: Ctrl-C is for us, and a picture that is being drawn is finished.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  pid_t process = -1;
  const int error_number =
      ::posix_spawnp(&process, program.c_str(), &actions, &attributes, pointers.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return error_number == 0 ? process : -error_number;
}

bool exits_with_success(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

store::Result<ProgramOutput> run_program(const std::string& program,
                                         const std::vector<std::string>& arguments,
                                         const std::string& input) {
  MemoryFile in("input"), out("output"), errors("errors");
  if (!in.is_open() || !out.is_open() || !errors.is_open() || !in.fill(input)) {
    return store::Error{store::Error::Kind::failed,
                        fmt::format("cannot start {}: no memory for its input", program)};
  }
  const pid_t process = start(program, arguments, in, out, errors);
  if (process < 0) {
    const auto kind = process == -ENOENT ? store::Error::Kind::missing : store::Error::Kind::failed;
    return store::Error{
        kind, fmt::format("cannot start {}: {}", program, std::generic_category().message(-process))};
  }
  const bool succeeded = exits_with_success(process);
  return ProgramOutput{out.content(), errors.content(), succeeded};
}

}  // namespace launchsafe::report
