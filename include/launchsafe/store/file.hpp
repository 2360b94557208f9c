// Files that are there whole or not at all, also after a kill, a full disk or a power cut; their SHA-256;
// other programs; and errors of files and programs as values.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>

namespace launchsafe::store {

/// What went wrong, for a person (`message` names the file), and its kind, for the caller's decision.
struct Error {
  enum class Kind {
    missing,       ///< there is no such file or program
    unreadable,    ///< it is there and could not be read (permission, device)
    corrupt,       ///< truncated, damaged, or not of this format: set it aside and compute again
    held,          ///< another process writes it
    conflict,      ///< a different result is already there; nothing was written
    write_failed,  ///< nothing was written under the target name
    failed         ///< a program that was called failed
  };
  Kind kind = Kind::failed;
  std::string message;
};

/// Empty when all went well.
using MaybeError = std::optional<Error>;

/// A value, or the reason why there is none.
template <class T>
using Result = scene::Expected<T, Error>;

/// Digest of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

enum class IfExists { replace, refuse };

/// Whether a file of this name is one that is being written, or what a kill left of it.
bool is_temporary(std::string_view name);
/// Removes such files from a folder in which nobody writes. Failures are of no consequence.
void remove_leftovers(const std::filesystem::path& folder);

/// Writes a file under a temporary name in the folder of `path`, syncs, renames, and syncs the folder. On an
/// error nothing is left under either name and what was at `path` before is untouched (except when only the
/// last step, syncing the folder, fails: then the new file is there, whole, but might not survive a power
/// cut). Errors: write_failed; conflict when `path` exists and `if_exists` is refuse. A process under a
/// file-size limit must ignore SIGXFSZ to see the error rather than die of the signal.
MaybeError write_file_atomically(const std::filesystem::path& path, std::string_view content,
                                 IfExists if_exists);

/// The folder of a file; "." of one that is named without.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// The whole content of a regular file. Errors: missing, unreadable.
Result<std::string> read_file(const std::filesystem::path& path);

// --- calling another program ---

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

/// Runs a program (found in PATH, no shell) to its end with `input` on its stdin. Input and output go through
/// files in memory: no pipe can block or break. It ends with all that it started in its process group: when
/// it exits, or when a limit is reached. Errors: missing, failed (it could not be started, or was ended).
Result<ProgramOutput> run_program(const std::string& program, const std::vector<std::string>& arguments,
                                  const std::string& input, const ProgramLimits& limits = {});

}  // namespace launchsafe::store
