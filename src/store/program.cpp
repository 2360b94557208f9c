#include "posix_file.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

namespace launchsafe::store {
namespace {

/// A nameless file in memory.
Descriptor memory_file(const char* name) { return Descriptor(::memfd_create(name, MFD_CLOEXEC)); }

bool fill(const Descriptor& file, const std::string& content) {
  return file.is_open() && write_all(file.number(), content) && ::lseek(file.number(), 0, SEEK_SET) == 0;
}

std::string written_on(const Descriptor& file) {
  std::string content;
  std::array<char, 1 << 12> part{};  // stacks may be small
  for (;;) {
    const ssize_t taken =
        ::pread(file.number(), part.data(), part.size(), static_cast<off_t>(content.size()));
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) return content;
    content.append(part.data(), static_cast<std::size_t>(taken));
  }
}

/// The process id, or the negative error number.
pid_t start(const std::string& program, const std::vector<std::string>& arguments, const Descriptor& input,
            const Descriptor& output, const Descriptor& errors) {
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
  // In a group of its own: Ctrl-C is for us, and whatever it starts can be ended with it.
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

/// Whether it has ended. It is not reaped, so that its number, which is that of its group, stays taken.
bool has_ended(pid_t process) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid == process;
}

/// Waits for the end. Why it must not go on, or nothing once it has ended.
std::string wait_for_end(pid_t process, const ProgramLimits& limits) {
  using namespace std::chrono_literals;
  const auto start = std::chrono::steady_clock::now();
  auto pause = 1ms;
  while (!has_ended(process)) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (limits.stop != nullptr && limits.stop->load()) return "the program was asked to stop";
    if (elapsed.count() > limits.time)
      return fmt::format("it was not done after {:.3g} s and was ended", limits.time);
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, 20ms);
  }
  return {};
}

/// Ends what is left of its group, and tells whether it exited with success.
bool end_group(pid_t process) {
  ::kill(-process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

Result<ProgramOutput> run_program(const std::string& program, const std::vector<std::string>& arguments,
                                  const std::string& input, const ProgramLimits& limits) {
  const Descriptor in = memory_file("input"), out = memory_file("output"), errors = memory_file("errors");
  if (!out.is_open() || !errors.is_open() || !fill(in, input))
    return Error{Error::Kind::failed, fmt::format("cannot start {}: no memory for its input", program)};
  const pid_t process = start(program, arguments, in, out, errors);
  if (process < 0) {
    const auto kind = process == -ENOENT ? Error::Kind::missing : Error::Kind::failed;
    return Error{kind, fmt::format("cannot start {}: {}", program, system_reason(-process))};
  }
  const std::string ended = wait_for_end(process, limits);
  const bool succeeded = end_group(process);
  if (!ended.empty()) return Error{Error::Kind::failed, fmt::format("{}: {}", program, ended)};
  return ProgramOutput{written_on(out), written_on(errors), succeeded};
}

}  // namespace launchsafe::store
