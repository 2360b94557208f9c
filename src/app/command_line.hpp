// The command line: what can be written on it, and its help.
#pragma once

#include "commands.hpp"

#include <string>
#include <variant>
#include <vector>

namespace launchsafe::app {

/// What `--help` or `--version` asks for.
struct Information {
  std::string help;
  bool version = false;  ///< it is the version that is asked for
};
/// Why the command line makes no sense.
struct UsageError {
  std::string message;
};

using Request = std::variant<Information, UsageError, RunArguments, StudyArguments, MergeArguments,
                             EmitArguments, VerifyArguments, ExplainArguments, PlotArguments, InitArguments,
                             ImportCurveArguments, ReportArguments>;

struct CommandLine {
  Request request;
  std::string command;  ///< "run"; empty where there is none
  bool quiet = false;
  bool json = false;  ///< also where the rest of the command line makes no sense
};

/// An option or a positional argument as the help tells it.
struct OptionDescription {
  std::string names;  ///< "--output,-o"; of a positional its name
  std::string type;   ///< "DIR"; empty for a flag
  std::string meaning;
  bool positional = false;
};
/// A command with its options, as CLI11 has it.
struct CommandDescription {
  std::string name, meaning;
  std::string footer;  ///< examples and remarks
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> subcommands;
};
/// The program with all its commands.
CommandDescription describe_commands();

CommandLine parse_command_line(int argument_count, const char* const* arguments);

}  // namespace launchsafe::app
