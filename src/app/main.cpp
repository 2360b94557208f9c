#include "commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>

namespace {

using namespace launchsafe;
using namespace launchsafe::app;

constexpr const char* out_of_memory = "out of memory";
constexpr const char* unknown_error = "internal error: an exception of an unknown kind";

#if LAUNCHSAFE_CHOOSES_PROGRAM && defined(__x86_64__)

/// An installation holds the same program for several kinds of processor. Where one for wider vectors is
/// installed that this processor runs, that one takes over and this does not return. Which one computes is in
/// `launchsafe --version` and in every manifest. LAUNCHSAFE_ARCHITECTURE in the environment, one of x86-64,
/// x86-64-v3 and x86-64-v4, limits the choice: results of several processors then agree to the last digit.
void become_faster_program(char** arguments) {
  const char* given = std::getenv("LAUNCHSAFE_ARCHITECTURE");
  const std::string_view most = given ? given : "";
  bool allowed = most.empty();
  std::error_code unknown;
  const path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  // bin/launchsafe has its faster forms in lib/launchsafe/ARCHITECTURE/launchsafe.
  const path forms = self.parent_path().parent_path() / "lib" / "launchsafe";
  for (const auto& [name, runs_here] : {std::pair{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0},
                                        std::pair{"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0}}) {
    allowed = allowed || most == name;
    // What is missing, or no program, is passed over: this one does the same, more slowly.
    if (allowed && runs_here) ::execv((forms / name / "launchsafe").c_str(), arguments);
  }
}

#else

void become_faster_program(char**) {}

#endif

static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void request_stop(int) { stop_requested().store(true, std::memory_order_relaxed); }

void stop_on(int signal) {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}

/// From here on the first SIGINT, SIGTERM or SIGHUP sets the flag of `stop_requested`, and a second one ends
/// the program at once (files are whole or not there, so that is safe). Writing to a closed pipe or past a
/// file-size limit becomes an error of the write instead of the program's end.
void catch_signals() {
  stop_on(SIGINT);
  stop_on(SIGTERM);
  // `nohup` has it ignored, and means it.
  struct sigaction present {};
  if (sigaction(SIGHUP, nullptr, &present) != 0 || present.sa_handler != SIG_IGN) stop_on(SIGHUP);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

/// What needs less: a run is large for its cells, a study for its cases.
std::string out_of_memory_in(const std::string& command) {
  if (command == "run" || command == "explain")
    return std::string(out_of_memory) + "; a coarser numerics.cell_size needs less";
  if (command == "study" || command == "emit" || command == "merge")
    return std::string(out_of_memory) + "; fewer cases in the study, or fewer --jobs, need less";
  return out_of_memory;
}

/// Whatever a command throws is its error.
ExitCode perform_request(const CommandLine& line, Console& console) {
  try {
    return line.perform(console);
  } catch (const Ended& end) {
    return end.code;
  } catch (const std::bad_alloc&) {
    console.error(out_of_memory_in(line.command));
  } catch (const std::exception& error) {
    console.error(fmt::format("internal error: {}", error.what()));
  } catch (...) {
    console.error(unknown_error);
  }
  return ExitCode::failed;
}

/// An exception that nobody could catch: of a static object, of a thread, out of a destructor.
[[noreturn]] void end_on_uncaught() {
  const std::exception_ptr thrown = std::current_exception();
  try {
    if (thrown) std::rethrow_exception(thrown);
    fail_at_once("internal error: std::terminate was called");
  } catch (const std::bad_alloc&) {
    fail_at_once(out_of_memory);
  } catch (const std::exception& error) {
    fail_at_once(error.what());
  } catch (...) {
    fail_at_once(unknown_error);
  }
  std::_Exit(static_cast<int>(ExitCode::failed));
}

/// What has to hold before any other static object of ours is made.
struct Groundwork {
  Groundwork() {
    reserve_standard_descriptors();
    std::set_terminate(end_on_uncaught);
  }
};
[[gnu::init_priority(101)]] const Groundwork groundwork;

}  // namespace

int main(int argument_count, char** arguments) {
  become_faster_program(arguments);
  catch_signals();
  const CommandLine line = parse_command_line(argument_count, arguments);
  Console console(line.quiet, line.json);
  // "launchsafe run 1": what the JSON object of a command is, and its version, raised when members change
  // their meaning or go.
  constexpr int version = 1;
  console.print_json(
      {{"format", fmt::format("launchsafe {}{}{}", line.command, line.command.empty() ? "" : " ", version)}});
  const ExitCode code = perform_request(line, console);
  return static_cast<int>(console.finish(code));
}
