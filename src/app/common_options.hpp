// What can be written on a command line. Each subcommand lives in a file of its own, with its options; their
// types, their meaning and what is allowed are words of templates/help/options.txt. And the folders that they
// use.
#pragma once

#include "console.hpp"

#include <CLI/CLI.hpp>

namespace launchsafe::app {

/// What was written on it.
struct CommandLine {
  std::function<ExitCode(Console&)> perform;  ///< what is asked for
  std::string command;                        ///< "run"; empty where there is none
  std::string text;                           ///< the whole of it, to be repeated in a shell
  bool quiet = false;
  bool json = false;  ///< also where the rest of the command line makes no sense
};

/// Adds a subcommand, which sets what is performed.
using AddCommand = void(CLI::App& app, CommandLine& line);
AddCommand add_run, add_study, add_status, add_merge, add_explain, add_plot, add_init, add_import_curve,
    add_report;

using scene::Dimension;

/// SI, of a quantity as scenes have them: "5 MPa", "-0.3 bar", "0.2 ms", "155 mm". Throws why it is none,
/// which `add_read` tells.
template <Dimension dimension>
double parse_scene_quantity(std::string_view text) {
  return scene::parse_quantity(text, dimension).or_throw();
}
/// The same of what is more than zero, such as "8GB", and at most 1e18, which whole numbers count.
template <Dimension dimension>
std::optional<double> parse_positive(std::string_view text) {
  const double value = parse_scene_quantity<dimension>(text);
  return value > 0.0 && value <= 1e18 ? std::optional(value) : std::nullopt;
}

/// What the help of a command says below its options.
std::string footer_of(const std::string& command);

/// What the help says of a command, or of an option: one of its own, or one that several commands have.
struct OptionWords {
  std::string type, meaning;
  std::string allowed;  ///< of one whose text is read, as the error says it
};
const OptionWords& words_of(const std::string& command, const std::string& option);

/// A subcommand and what its options write to while CLI11 parses, with which it is performed.
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& app, CommandLine& line, const char* name) {
  CLI::App& command = *app.add_subcommand(name, words_of({}, name).meaning);
  command.footer(footer_of(name));
  const auto arguments = std::make_shared<Arguments>();
  if constexpr (requires { arguments->command; }) arguments->command = line.text;
  command.callback([&line, arguments, name] {
    line.perform = [arguments](Console& console) { return perform(*arguments, console); };
    line.command = name;
  });
  return {command, *arguments};
}

/// Where to read how to write a command line of a command, "report ", or of any, "", that makes no sense.
inline std::string usage_hint(const std::string& command) {
  return fmt::format(" (launchsafe {}--help shows the usage)", command);
}

/// Refuses `-o --json`, which would name a file or folder that nobody means, and "". `type`: what the help
/// calls it.
CLI::Validator real_name(const std::string& type);

/// An option, or without dashes an argument.
template <class Value>
CLI::Option* add(CLI::App& command, const std::string& name, Value& value) {
  const OptionWords& words = words_of(command.get_name(), name);
  if constexpr (std::is_same_v<Value, bool>) return command.add_flag(name, value, words.meaning);
  CLI::Option* option = command.add_option(name, value, words.meaning)->type_name(words.type);
  constexpr bool is_path = std::is_same_v<Value, path> || std::is_same_v<Value, std::optional<path>> ||
                           std::is_same_v<Value, std::vector<path>>;
  return is_path ? option->check(real_name(words.type)) : option;
}
/// What must be given.
template <class Value>
CLI::Option* add_required(CLI::App& command, const std::string& name, Value& value) {
  return add(command, name, value)->required();
}

/// An option whose text is read by `read`; one for which that is false, or throws an InputError, is refused.
CLI::Option* add_read(CLI::App& command, const std::string& name,
                      std::function<bool(const std::string&)> read);
/// The same of an amount, of which `parse` makes nothing for any other text.
template <class Amount, class Parse>
CLI::Option* add_amount(CLI::App& command, const char* name, std::optional<Amount>& value, Parse parse) {
  return add_read(command, name,
                  [&value, parse](const std::string& text) { return (value = parse(text)).has_value(); });
}

/// An option that takes a whole number from 1 to `most`, in decimal digits.
CLI::Option* add_count(CLI::App& command, const std::string& name, int& count, int most);
void add_jobs(CLI::App& command, int& jobs);

// --- the folders that a user names for results, and that of a study: whether it may be used, and what
// becomes of an earlier study's report in it ---

/// Makes the folder where it does not exist. A message when it cannot be made or written to, so that a run
/// finds out before it computes rather than after.
std::optional<std::string> prepare_output_folder(const path& folder);

using NamedTexts = std::vector<report::TextFile>;

/// Where files of these names lie in a folder, as the user named it.
std::vector<std::string> places_of(const path& folder, const NamedTexts& texts);

/// Writes files into a folder, which is made where there is none: all of them, or none where one may not be
/// written, which ends the command. "wrote scene.toml", or "kept" of what is there with this content.
std::vector<std::string> write_where_absent(const path& folder, const NamedTexts& texts, Console& console);

using store::StudyRecord;

/// The manifest of a study: its input is the model version, what the study file says, without remarks and in
/// sorted order, and the scene with what the study sets in it. Every case follows from these.
store::Manifest study_manifest(const study::StudyFile& file, int jobs);

/// Whether both ask the same of the same model.
bool same_study(const store::Manifest& one, const store::Manifest& other);

/// Whether the folder holds cases that a study stored.
bool holds_store(const path& folder);

/// Why the results of a study may not go into the folder: it is not empty and has no manifest of ours, or it
/// holds those of a different study and `update` is not set. Nothing is changed.
std::optional<std::string> obstacle_in_folder(const path& folder, const store::Manifest& manifest,
                                              bool update);

}  // namespace launchsafe::app
