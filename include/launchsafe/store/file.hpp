// Files that are there whole or not at all, also after a kill, a full disk or a power cut; their SHA-256; and
// other programs.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>

namespace launchsafe::store {

/// What went wrong, for a person (`message` names the file), and its kind, for the caller's decision. It is
/// thrown; functions of this module that throw name the kinds.
struct Error {
  enum class Kind {
    missing,       ///< there is no such file or program
    unreadable,    ///< it is there and could not be read (permission, device)
    corrupt,       ///< truncated, damaged, or not of this format
    conflict,      ///< something else is there, or another process is at work there; nothing was written
    write_failed,  ///< nothing was written under the target name
    failed         ///< a program that was called failed
  };
  Kind kind = Kind::failed;
  std::string message;
};

/// A value, or the reason why there is none.
template <class T>
using Result = scene::Expected<T, Error>;

/// Digest of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

enum class IfExists { replace, refuse };

/// Whether a file of this name is one that is being written, or the rest of one whose writer was killed.
bool is_temporary(std::string_view name);
/// Removes such files from a folder in which nobody writes. Failures are of no consequence.
void remove_leftovers(const std::filesystem::path& folder);

/// Writes a file under a temporary name in the folder of `path`, syncs, renames, and syncs the folder. On an
/// error nothing is left under the temporary name, and a file that was at `path` before is untouched. Errors:
/// write_failed; conflict when `path` exists and `if_exists` is refuse. A process under a file-size limit
/// must ignore SIGXFSZ to see the error rather than die of the signal.
void write_file_atomically(const std::filesystem::path& path, std::string_view content, IfExists if_exists);

/// The folder of a file; "." of one that is named without.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// The whole content of a regular file. Errors: missing, unreadable.
std::string read_file(const std::filesystem::path& path);

/// "cannot write PATH: REASON", of kind write_failed; the reason is that of an errno value.
Error write_error(const std::filesystem::path& path, int error_number);

/// "PATH WHAT, and nothing is overwritten ...", of kind conflict.
Error refusal(const std::filesystem::path& path, std::string_view what);

// --- calling another program ---

struct ProgramLimits {
  double time = 60.0;  ///< s of wall time, after which the program is ended
  /// Set from another thread (or a signal handler) so that no other program is started.
  const std::atomic<bool>* stop = nullptr;
};

struct ProgramOutput {
  std::string output, errors;  ///< its stdout and stderr
  bool succeeded = false;      ///< it exited with code 0
};

/// Runs a program (found in PATH) to its end with `input` on its stdin. Errors: missing, failed (it could not
/// be started, or was ended by a limit).
Result<ProgramOutput> run_program(const std::string& program, const std::vector<std::string>& arguments,
                                  const std::string& input, const ProgramLimits& limits = {});

}  // namespace launchsafe::store
