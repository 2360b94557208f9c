// What can be written on a command line. Each subcommand lives in a file of its own, with its options. And
// the folders that they use.
#pragma once

#include "console.hpp"

#include <CLI/CLI.hpp>

namespace launchsafe::app {

/// What was written on it.
struct CommandLine {
  std::function<ExitCode(Console&)> perform;  ///< what is asked for
  std::string command;                        ///< "run"; empty where there is none
  std::string text;                           ///< the whole of it, to be repeated in a shell
  bool quiet = false, json = false;
};

/// Adds a subcommand, which sets what is performed.
using AddCommand = void(CLI::App& app, CommandLine& line);
AddCommand add_run, add_study, add_status, add_merge, add_explain, add_plot, add_init, add_import_curve,
    add_report;

/// A subcommand and what its options write to while CLI11 parses, with which it is performed.
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& app, CommandLine& line, const std::string& name,
                                             const char* meaning) {
  CLI::App& command = *app.add_subcommand(name, meaning);
  command.footer("\n" + help_texts().at(name + ".txt"));
  const auto arguments = std::make_shared<Arguments>();
  if constexpr (requires { arguments->command; }) arguments->command = line.text;
  command.callback([&line, arguments, name] {
    line.perform = [arguments](Console& console) { return perform(*arguments, console); };
    line.command = name;
  });
  return {command, *arguments};
}

/// An option, or without dashes an argument. `type`: what the help calls its value.
template <class Value>
CLI::Option* add(CLI::App& command, const char* name, Value& value, const char* type, const char* meaning) {
  return command.add_option(name, value, meaning)->type_name(type);
}

/// An option whose text `read` reads; a text for which that is false is refused, with what is allowed.
CLI::Option* add_read(CLI::App& command, const std::string& name, const char* type, const char* meaning,
                      const std::string& allowed, std::function<bool(const std::string&)> read);

/// An option that takes a quantity as scenes have them, such as "5 MPa", in SI from `least` to `most`.
CLI::Option* add_quantity(CLI::App& command, const std::string& name, std::optional<double>& value,
                          scene::Dimension dimension, const char* meaning, const std::string& allowed,
                          double least = 1e-300, double most = 1e18);

/// Threads at a time.
void add_jobs(CLI::App& command, int& jobs);

// --- the folders that a user names for results ---

/// Makes the folder where it does not exist. Throws where it cannot be made or written to, so that a run
/// finds out before it computes rather than after.
void prepare_output_folder(const path& folder);

using NamedTexts = std::vector<report::TextFile>;

/// Writes files into a folder, which is made where there is none: all of them, or none where one is there
/// with another content. Their places, as the user named the folder.
std::vector<std::string> write_where_absent(const path& folder, const NamedTexts& texts);

}  // namespace launchsafe::app
