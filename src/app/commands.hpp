// The subcommands: what each is given, and what it does. Each lives in a file of its own.
#pragma once

#include "console.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace launchsafe::app {

struct RunArguments {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> output;  ///< folder of the case file; none: nothing is written
};
ExitCode run_command(const RunArguments& arguments, Console& console);

struct StudyArguments {
  std::filesystem::path study;
  std::filesystem::path output;  ///< folder of cases, tables and report
  int jobs = 0;                  ///< threads; 0: as many as there are processors for us
};
ExitCode study_command(const StudyArguments& arguments, Console& console);

struct VerifyArguments {
  std::string filter;  ///< part of a check's group or name, case ignored
};
ExitCode verify_command(const VerifyArguments& arguments, Console& console);

struct ExplainArguments {
  std::filesystem::path file;  ///< scene or study; empty with `keys`
  bool keys = false;
};
ExitCode explain_command(const ExplainArguments& arguments, Console& console);

}  // namespace launchsafe::app
