#include "common_options.hpp"
#include "launchsafe/store/manifest.hpp"
#include "launchsafe/version.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

namespace launchsafe::app {
namespace {

constexpr const char* description =
    "launchsafe: how thick may the gap under an explosive charge be before a launch can ignite it?\n"
    "Simulates shells under launch loads by the material point method.";

/// Version, commit, compiler, flags and libraries.
ExitCode print_version(Console& console) {
  std::string text;
  Json libraries = Json::object();
  for (const store::LibraryVersion& library : store::library_versions()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", library.name, library.version);
    libraries[library.name] = library.version;
  }
  console.print_text(fmt::format(
      "launchsafe {}\ncommit    {}\ncompiler  {}\nflags     {} ({})\nlibraries {}\n", version::number,
      version::commit, version::compiler, version::flags, version::build_type, text));
  console.print_json({{"version", version::number},
                      {"commit", version::commit},
                      {"compiler", version::compiler},
                      {"flags", version::flags},
                      {"build_type", version::build_type},
                      {"libraries", libraries}});
  return ExitCode::done;
}

std::function<ExitCode(Console&)> print(const std::string& help) {
  return [help](Console& console) {
    console.print_text(help);
    console.print_json({{"help", help}});
    return ExitCode::done;
  };
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

/// What is not among these words, with the nearest of them; `place` is where it stands.
std::string unknown_word(const std::string& place, const std::string& word, const std::string& allowed,
                         const std::vector<std::string>& known) {
  const std::string nearest = word == "help" ? "--help" : scene::nearest_of(word, known);
  return scene::InputError{{}, 0, 0, place, '"' + word + '"', allowed, nearest}.message();
}

/// The first command or option that there is none of; empty where all are known.
std::string unknown_word_in(const CLI::App& app, int argument_count, const char* const* arguments) {
  if (argument_count < 2 || arguments[1][0] == '-') return {};
  const std::string given = arguments[1];
  std::vector<std::string> commands, options;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
    if (command->get_name() != given) continue;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  if (options.empty()) return unknown_word("", given, fmt::format("{}", fmt::join(commands, ", ")), commands);
  for (int i = 2; i < argument_count; ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--") break;
    const std::string name(argument.substr(0, argument.find('=')));
    if (name.starts_with("--") && std::ranges::find(options, name) == options.end())
      return unknown_word(given, name, "the options that launchsafe " + given + " --help lists", options);
  }
  return {};
}

void add_commands(CLI::App& app, CommandLine& line) {
  app.require_subcommand(1);
  app.footer(footer_of("launchsafe"));
  app.set_version_flag("--version", "", "Version, commit, compiler, flags and libraries");
  const auto print_completion = [&app, &line] {
    line.perform = print(bash_completion(app));
    throw CLI::Success();
  };
  app.add_flag_callback("--bash-completion", print_completion,
                        "A script by which bash completes commands, options and their values: eval it");
  for (AddCommand* add : {add_run, add_study, add_status, add_merge, add_emit, add_ask, add_verify,
                          add_explain, add_plot, add_init, add_import_curve, add_report})
    add(app, line);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    add(*command, "--json", line.json);
    add(*command, "-q,--quiet", line.quiet);
  }
}

}  // namespace

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
    const std::string unknown = unknown_word_in(app, argument_count, arguments);
    line.perform = [fault = (unknown.empty() ? error.what() : unknown) + usage_hint](Console& console) {
      return console.refuse(fault);
    };
  }
  line.json = asks_for_json(argument_count, arguments);
  return line;
}

}  // namespace launchsafe::app
