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

/// A name for the file that is to become NAME while it is written: `.NAME.NUMBER.partial`, where NUMBER is 16
/// hexadecimal digits, eight at random and eight that follow from them and NAME. So nobody else's file has
/// such a name by chance, and one that no living process writes is the remains of a kill.
std::string temporary_name(std::string_view name);
/// NAME of such a name; nothing for any other.
std::optional<std::string> name_behind(std::string_view temporary);
/// Removes a regular file with a temporary name; anything else stays. Failures are of no consequence.
void remove_leftover(const std::filesystem::path& file);

/// Writes a file under a temporary name in the folder of `path`, syncs, renames, and
/// syncs the folder. The temporary name is that of `name`, or of the file itself where that is empty. On an
/// error nothing is left under either name and what was at `path` before is untouched (except when only the
/// last step, syncing the folder, fails: then the new file is there, whole, but might not survive a power
/// cut). Errors: write_failed; conflict when `path` exists and `if_exists` is refuse. A process under a
/// file-size limit must ignore SIGXFSZ to see the error rather than die of the signal.
MaybeError write_file_atomically(const std::filesystem::path& path, std::string_view content,
                                 IfExists if_exists, const std::string& name = {});

/// The folder of a file; "." of one that is named without.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Renames, never over something that is there: then the error is file_exists.
std::error_code move_to_free_name(const std::filesystem::path& from, const std::filesystem::path& to);

/// Renames to the first free one of STEM-1, STEM-2, ... and returns it. Errors: write_failed.
Result<std::filesystem::path> move_to_numbered_name(const std::filesystem::path& from,
                                                    const std::filesystem::path& stem);

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

/// Bytes that a program may write on stdout, and on stderr.
inline constexpr std::int64_t most_program_output = 64 << 20;

/// Runs a program (found in PATH, no shell) to its end with `input` on its stdin. Input and output go through
/// files in memory: no pipe can block or break. It ends with all that it started in its process group: when
/// it exits, when a limit is reached, or when it writes more than `most_program_output`. Errors: missing,
/// failed (it could not be started, or was ended).
Result<ProgramOutput> run_program(const std::string& program, const std::vector<std::string>& arguments,
                                  const std::string& input, const ProgramLimits& limits = {});

}  // namespace launchsafe::store
