// Options that several commands have, and those whose text is an amount with a unit.
#pragma once

#include "commands.hpp"
#include "launchsafe/scene/quantity.hpp"
#include "launchsafe/study/options.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace launchsafe::app {

/// SI, of a quantity as scenes have them: "5 MPa", "-0.3 bar", "0.2 ms", "155 mm".
template <scene::Dimension dimension>
std::optional<double> parse_scene_quantity(std::string_view text) {
  const auto value = scene::parse_quantity(text, dimension);
  return value ? std::optional(*value) : std::nullopt;
}
/// The same of what is more than zero.
template <scene::Dimension dimension>
std::optional<double> parse_positive(std::string_view text) {
  const auto value = parse_scene_quantity<dimension>(text);
  return value && *value > 0.0 ? value : std::nullopt;
}

/// What the help of a command says below its options.
std::string footer_of(const std::string& command);

/// A subcommand and what its options write to while CLI11 parses, with which it is performed.
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& app, CommandLine& line, const char* name,
                                             const char* meaning) {
  CLI::App& command = *app.add_subcommand(name, meaning);
  command.footer(footer_of(name));
  const auto arguments = std::make_shared<Arguments>();
  command.callback([&line, arguments, name] {
    line.perform = [arguments](Console& console) { return perform(*arguments, console); };
    line.command = name;
  });
  return {command, *arguments};
}

/// Where to read how to write a command line that makes no sense.
inline constexpr const char* usage_hint = " (launchsafe --help shows the usage)";

/// What must be given.
template <class Value>
CLI::Option* add_required(CLI::App& command, const char* name, Value& value, const char* type,
                          const char* meaning) {
  return command.add_option(name, value, meaning)->required()->type_name(type);
}

/// What may be given.
template <class Value>
CLI::Option* add_optional(CLI::App& command, const char* name, Value& value, const char* type,
                          const char* meaning) {
  return command.add_option(name, value, meaning)->type_name(type);
}

/// Refuses `-o --json`, which would name a folder or file (`kind`) that nobody means.
CLI::Validator no_option_name(const char* kind);

/// A place to write to: a `kind`, "folder" or "file", that the help calls `type`.
template <class Path>
CLI::Option* add_place(CLI::App& command, const char* name, Path& path, const char* type, const char* kind,
                       const char* meaning) {
  return command.add_option(name, path, meaning)->check(no_option_name(kind))->type_name(type);
}

template <class Path>
CLI::Option* add_folder(CLI::App& command, Path& path, const char* meaning) {
  return add_place(command, "-o,--output", path, "DIR", "folder", meaning);
}

/// An option whose text is read by `read`; one for which that is false is refused with what is `allowed`.
CLI::Option* add_read(CLI::App& command, const std::string& name,
                      std::function<bool(const std::string&)> read, const char* allowed, const char* type,
                      const char* meaning);
/// The same of an amount, of which `parse` makes nothing for any other text.
template <class Amount, class Parse>
CLI::Option* add_amount(CLI::App& command, const char* name, std::optional<Amount>& value, Parse parse,
                        const char* allowed, const char* type, const char* meaning) {
  const auto read = [&value, parse](const std::string& text) { return (value = parse(text)).has_value(); };
  return add_read(command, name, read, allowed, type, meaning);
}

/// A script for bash that completes commands, options and what these take.
std::string bash_completion(const CLI::App& app);

/// --longest-run, s.
void add_longest_run(CLI::App& command, std::optional<double>& longest_run);
/// --jobs.
void add_jobs(CLI::App& command, int& jobs, const char* meaning);
/// --memory, bytes, and --time-limit, s.
void add_limits(CLI::App& command, std::optional<double>& memory, std::optional<double>& time_limit);
/// --tolerance, K.
void add_tolerance(CLI::App& command, std::optional<double>& tolerance);
/// --update.
void add_update(CLI::App& command, bool& update);

}  // namespace launchsafe::app
