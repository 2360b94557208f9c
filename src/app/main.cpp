// The program: the command line, what ends the program early, and `main`.
#include "common_options.hpp"
#include "launchsafe/version.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sstream>

namespace launchsafe::app {
namespace {

// --- the command line ---

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

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// What is wrong with a word that a command, or the program itself, does not take.
std::string fault_of_word(const std::string& word, const CLI::App& command) {
  std::vector<std::string> known = option_names(command);
  for (const CLI::App* each : command.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(each->get_name());
  const std::string nearest =
      word.ends_with(".toml") ? "launchsafe study " + word : scene::nearest_of(word, known);
  return scene::InputError{
      {}, 0, 0, command.get_name(), '"' + word + '"', fmt::format("{}", fmt::join(known, ", ")), nearest}
      .message();
}

void add_commands(CLI::App& app, CommandLine& line) {
  app.require_subcommand(1);
  app.footer("\n" + help_texts().at("launchsafe.txt"));
  app.set_version_flag("--version", "", "Version, commit, compiler and flags");
  for (AddCommand* add : {add_run, add_study, add_status, add_merge, add_explain, add_plot, add_init,
                          add_import_curve, add_report})
    add(app, line);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    command->add_flag("--json", line.json, "Print one JSON object on stdout instead of text");
    command->add_flag("-q,--quiet", line.quiet, "No progress and no remarks on stderr; errors remain");
  }
}

/// What is asked for; of a command line that makes no sense, what is wrong with it.
CommandLine parse_command_line(int argument_count, const char* const* arguments) {
  const std::vector<std::string> words(arguments, arguments + argument_count);
  CLI::App app(
      "launchsafe: how thick may the gap under an explosive charge be before a launch can ignite it?\n"
      "Simulates shells under launch loads by the material point method.",
      "launchsafe");
  CommandLine line;
  line.text = shell_command(words);
  add_commands(app, line);
  const auto end_with = [&](const auto& fault) {
    line.perform = [fault](Console&) -> ExitCode { throw fault; };
  };
  try {
    app.parse(argument_count, arguments);
    return line;
  } catch (const CLI::CallForVersion&) {
    line.perform = print_version;
  } catch (const CLI::Success& success) {
    std::ostringstream help;
    app.exit(success, help, help);
    line.perform = [text = help.str()](Console& console) { return console.done(text, {{"help", text}}); };
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> called = app.get_subcommands();
    const CLI::App& command = called.empty() ? app : *called.front();
    std::vector<std::string> unknown = app.remaining(true);
    std::erase(unknown, "--json");  // which every command has
    end_with(Ended{fmt::format("{} (launchsafe {}--help shows the usage)",
                               unknown.empty() ? error.what() : fault_of_word(unknown.front(), command),
                               called.empty() ? "" : command.get_name() + " ")});
  } catch (const scene::InputError& error) {
    end_with(error);
  }
  line.json = std::ranges::find(words, "--json") != words.end();
  return line;
}

#if LAUNCHSAFE_CHOOSES_PROGRAM && defined(__x86_64__)

/// Where an installation holds the program for wider vectors that this processor has, that one takes over and
/// this does not return. LAUNCHSAFE_ARCHITECTURE in the environment (x86-64, x86-64-v3 or x86-64-v4) limits
/// the choice.
void become_faster_program(char** arguments) {
  const char* given = std::getenv("LAUNCHSAFE_ARCHITECTURE");
  const std::string_view most = given ? given : "x86-64-v4";
  std::error_code unknown;
  const path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const path forms = self.parent_path().parent_path() / "lib" / "launchsafe";
  for (const auto& [name, runs_here] : {std::pair{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0},
                                        std::pair{"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0}})
    if (name <= most && runs_here) ::execv((forms / name / "launchsafe").c_str(), arguments);
}

#else

void become_faster_program(char**) {}

#endif

// --- what ends the program early ---

/// The program's last words where it ends without its command; nothing allocates in a signal handler.
const char* last_words = "";

void stop_at_once(int) {
  if (::write(STDERR_FILENO, last_words, std::strlen(last_words)) < 0) ::_exit(70);
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

void request_stop(int) {
  stop_requested = true;
  ::alarm(1);  // s, which leaves a busy machine another to end in
}

/// From here on the first SIGINT, SIGTERM or SIGHUP sets `stop_requested`. A command that does not end by
/// itself within a second is ended then, and by a second signal at once (files are whole or not there, so
/// that is safe). Writing to a closed pipe or past a file-size limit becomes an error of the write instead of
/// the program's end.
void catch_signals() {
  const auto handle = [](int signal, void (*handler)(int)) {
    struct sigaction action {
    }, before{};
    action.sa_handler = handler;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    // `nohup` has SIGHUP ignored, and means it.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr);
  };
  handle(SIGALRM, stop_at_once);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, request_stop);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Performs the command; whatever it throws is its error.
ExitCode perform_request(const CommandLine& line, Console& console) {
  using Kind = store::Error::Kind;
  try {
    return line.perform(console);
  } catch (const Ended& end) {
    console.error(end.message);
    return end.code;
  } catch (const scene::InputError& error) {
    console.error(error.message(), error);
    return ExitCode::bad_input;
  } catch (const store::Error& error) {
    console.error(error.message);
    const bool is_of_machine = error.kind == Kind::write_failed || error.kind == Kind::failed;
    return is_of_machine ? ExitCode::failed : ExitCode::bad_input;
  } catch (const std::bad_alloc&) {
    console.error("out of memory; a coarser numerics.cell_size, or fewer --jobs, need less");
  } catch (const std::exception& error) {
    console.error(fmt::format("internal error: {}", error.what()));
  }
  return ExitCode::failed;
}

/// A standard descriptor that the caller closed must not become the number of a file of ours. Writing to it
/// still fails.
void reserve_standard_descriptors() {
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/dev/null", O_RDONLY);
  if (opened > STDERR_FILENO) ::close(opened);
}

}  // namespace
}  // namespace launchsafe::app

int main(int argument_count, char** arguments) {
  using namespace launchsafe::app;
  reserve_standard_descriptors();
  become_faster_program(arguments);
  catch_signals();
  const CommandLine line = parse_command_line(argument_count, arguments);
  const std::string words = "launchsafe: interrupted; finished cases are kept; to go on: " + line.text + "\n";
  last_words = words.c_str();
  Console console(line.quiet, line.json);
  // "launchsafe run 1": the JSON object of a command, and its version, raised when members change their
  // meaning or go.
  const std::string name = line.command.empty() ? "" : line.command + " ";
  console.print_json({{"format", "launchsafe " + name + "1"}});
  return static_cast<int>(console.finish(perform_request(line, console)));
}
