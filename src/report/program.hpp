// Calling another program.
#pragma once

#include "launchsafe/store/result.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

struct ProgramOutput {
  std::string output, errors;  ///< what it wrote on stdout and stderr
  bool succeeded = false;      ///< it exited with code 0
};

/// Runs a program (found in PATH, no shell) to its end with `input` on its stdin. Input and output go through
/// files in memory: no pipe can block or break. Errors: missing, failed (it could not be started).
store::Result<ProgramOutput> run_program(const std::string& program,
                                         const std::vector<std::string>& arguments, const std::string& input);

}  // namespace launchsafe::report
