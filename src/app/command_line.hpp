// The command line: what can be written on it, and its help.
#pragma once

#include "commands.hpp"

#include <string>
#include <variant>

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

using Request = std::variant<Information, UsageError, RunArguments, StudyArguments, StatusArguments,
                             MergeArguments, EmitArguments, VerifyArguments, ExplainArguments, PlotArguments,
                             InitArguments, ImportCurveArguments, ReportArguments, AskArguments>;

struct CommandLine {
  Request request;
  std::string command;  ///< "run"; empty where there is none
  bool quiet = false;
  bool json = false;  ///< also where the rest of the command line makes no sense
};

CommandLine parse_command_line(int argument_count, const char* const* arguments);

}  // namespace launchsafe::app
