// Calling another program.
#pragma once

#include "launchsafe/store/result.hpp"

#include <atomic>
#include <cstdint>

namespace launchsafe::store {

/// What ends a program that was called.
struct ProgramLimits {
  double time = 60.0;  ///< s of wall time
  /// Set from another thread (or a signal handler) to stop.
  const std::atomic<bool>* stop = nullptr;
};

struct ProgramOutput {
  std::string output, errors;  ///< what it wrote on stdout and stderr
  bool succeeded = false;      ///< it exited with code 0
};

/// Bytes that a program may write on stdout, and on stderr.
inline constexpr std::int64_t most_program_output = 64 << 20;

/// Runs a program (found in PATH, no shell) to its end with `input` on its stdin. Input and output go through
/// files in memory: no pipe can block or break. It ends with all that it started in its process group: when
/// it exits, when a limit is reached, or when it writes more than `most_program_output`. Errors: missing,
/// failed (it could not be started, or was ended).
Result<ProgramOutput> run_program(const std::string& program, const std::vector<std::string>& arguments,
                                  const std::string& input, const ProgramLimits& limits = {});

}  // namespace launchsafe::store
