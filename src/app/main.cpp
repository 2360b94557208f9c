// The program: the command line, what ends the program early, and `main`.
#include "common_options.hpp"
#include "launchsafe/version.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>

namespace launchsafe::app {
namespace {

// --- the command line ---

constexpr const char* description =
    "launchsafe: how thick may the gap under an explosive charge be before a launch can ignite it?\n"
    "Simulates shells under launch loads by the material point method.";

/// Version, commit, compiler and flags.
ExitCode print_version(Console& console) {
  return console.done(
      fmt::format("launchsafe {}\ncommit    {}\ncompiler  {}\nflags     {} ({})\n", version::number,
                  version::commit, version::compiler, version::flags, version::build_type),
      {{"version", version::number},
       {"commit", version::commit},
       {"compiler", version::compiler},
       {"flags", version::flags},
       {"build_type", version::build_type}});
}

std::function<ExitCode(Console&)> print(const std::string& help) {
  return [help](Console& console) { return console.done(help, {{"help", help}}); };
}

/// Whether --json is on a command line that is not read to its end.
bool asks_for_json(int argument_count, const char* const* arguments) {
  for (int i = 1; i < argument_count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--") return false;
    if (argument == "--json") return true;
  }
  return false;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// What is wrong with a word that a command, or the program itself, does not take: with the nearest that
/// there is, and the commands that have such an option. Empty where what lacks is the command.
std::string fault_of_word(const std::string& given, const CLI::App& command, const CLI::App& app) {
  const std::string word = given.substr(0, given.find('=')),
                    name = &command == &app ? "" : command.get_name();
  std::vector<std::string> known, others;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(each->get_name());
    const std::vector<std::string> options = option_names(*each);
    if (std::ranges::find(options, word) != options.end()) others.push_back(each->get_name());
  }
  if (others.size() == known.size()) return {};
  std::string allowed = fmt::format("{}", fmt::join(known, ", ")), elsewhere;
  if (word.starts_with('-')) {
    known = option_names(command);
    allowed = name.empty() ? "its options" : "options of " + name;
  } else if (!name.empty()) {
    known.clear();
    allowed = "no more arguments";
  }
  if (!others.empty()) elsewhere = fmt::format("; {} is an option of {}", word, fmt::join(others, ", "));
  std::string nearest = word == "help" ? "--help" : scene::nearest_of(word, known);
  if (name.empty() && word.ends_with(".toml")) nearest = "launchsafe study " + word;
  return scene::InputError{{}, 0, 0, name, '"' + word + '"', allowed, nearest}.message() + elsewhere;
}

/// "STUDY.toml is required", which the help calls so; empty for anything else that is wrong.
std::string missing_word_of(const CLI::App& command, const CLI::ParseError& error) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() && option->get_name() + " is required" == error.what())
      return words_of(command.get_name(), option->get_name()).type + " is required";
  return {};
}

void add_commands(CLI::App& app, CommandLine& line) {
  app.require_subcommand(1);
  app.footer(footer_of("launchsafe"));
  app.set_version_flag("--version", "", "Version, commit, compiler and flags");
  for (AddCommand* add : {add_run, add_study, add_status, add_merge, add_explain, add_plot, add_init,
                          add_import_curve, add_report})
    add(app, line);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    add(*command, "--json", line.json);
    add(*command, "-q,--quiet", line.quiet);
  }
}

/// What is asked for; also where the rest of the command line makes no sense.
CommandLine parse_command_line(int argument_count, const char* const* arguments) {
  CLI::App app(description, "launchsafe");
  CommandLine line;
  line.text = shell_command({arguments, arguments + argument_count});
  add_commands(app, line);
  try {
    app.parse(argument_count, arguments);
    return line;
  } catch (const CLI::CallForVersion&) {
    line.perform = print_version;
  } catch (const CLI::Success& success) {
    std::ostringstream help;
    app.exit(success, help, help);
    if (!help.str().empty()) line.perform = print(help.str());
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> called = app.get_subcommands();
    const CLI::App& command = called.empty() ? app : *called.front();
    std::string fault;
    if (const auto words = app.remaining(true); !words.empty())
      fault = fault_of_word(words.front(), command, app);
    if (fault.empty()) fault = missing_word_of(command, error);
    if (fault.empty()) fault = error.what();
    fault += usage_hint(called.empty() ? "" : command.get_name() + " ");
    line.perform = [fault](Console& console) -> ExitCode { console.refuse(fault); };
  }
  line.json = asks_for_json(argument_count, arguments);
  return line;
}

// --- what ends the program early ---

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

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// What the program says where it ends without its command; nothing allocates in a signal handler.
constinit std::atomic<const char*> last_words{"interrupted"};

void request_stop(int) {
  constexpr unsigned longest = 1;  // s, which leaves a busy machine another to end in
  stop_requested().store(true, std::memory_order_relaxed);
  ::alarm(longest);
}

void stop_at_once(int) {
  fail_at_once(last_words, "interrupted");
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}

void stop_on(int signal) { handle(signal, request_stop); }

/// From here on the first SIGINT, SIGTERM or SIGHUP sets the flag of `stop_requested`. A command that does
/// not end by itself within a second, whatever it is doing, is ended then, and by a second signal at once
/// (files are whole or not there, so that is safe). Writing to a closed pipe or past a file-size limit
/// becomes an error of the write instead of the program's end.
void catch_signals() {
  handle(SIGALRM, stop_at_once);
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
  if (command == "study" || command == "merge")
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
}  // namespace launchsafe::app

int main(int argument_count, char** arguments) {
  using namespace launchsafe::app;
  become_faster_program(arguments);
  catch_signals();
  const CommandLine line = parse_command_line(argument_count, arguments);
  last_words =
      ::strdup(fmt::format("interrupted; what was finished is kept; to go on: {}", line.text).c_str());
  Console console(line.quiet, line.json);
  // "launchsafe run 1": what the JSON object of a command is, and its version, raised when members change
  // their meaning or go.
  constexpr int version = 1;
  console.print_json(
      {{"format", fmt::format("launchsafe {}{}{}", line.command, line.command.empty() ? "" : " ", version)}});
  const ExitCode code = perform_request(line, console);
  return static_cast<int>(console.finish(code));
}
