// The command line: what can be written on it, and what is done then. Each subcommand lives in a file of its
// own, with its options.
#pragma once

#include "console.hpp"

namespace CLI {
class App;
}

namespace launchsafe::app {

struct CommandLine {
  std::function<ExitCode(Console&)> perform;  ///< what is asked for
  std::string command;                        ///< "run"; empty where there is none
  std::string text;                           ///< the whole of it, to be repeated in a shell
  bool quiet = false;
  bool json = false;  ///< also where the rest of the command line makes no sense
};

CommandLine parse_command_line(int argument_count, const char* const* arguments);

/// Adds a subcommand, which sets what is performed.
using AddCommand = void(CLI::App& app, CommandLine& line);
AddCommand add_run, add_study, add_status, add_merge, add_emit, add_ask, add_verify, add_explain, add_plot,
    add_init, add_import_curve, add_report;

}  // namespace launchsafe::app
