// Files that are there whole or not at all, also after a kill, a full disk or a power cut.
#pragma once

#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace launchsafe::store {

enum class IfExists { replace, refuse };

/// Ends the names of files that are being written. One that no living process writes is the remains of a
/// kill.
inline constexpr std::string_view partial_suffix = ".partial";

/// Writes the parts one after the other under a temporary name (`.NAME.RANDOM.partial`) in the folder of
/// `path`, syncs, renames, and syncs the folder. On an error nothing is left under either name and what was
/// at `path` before is untouched (except when only the last step, syncing the folder, fails: then the new
/// file is there, whole, but might not survive a power cut). Errors: write_failed; conflict when `path`
/// exists and `if_exists` is refuse. A process under a file-size limit must ignore SIGXFSZ to see the error
/// rather than die of the signal.
MaybeError write_file_atomically(const std::filesystem::path& path,
                                 std::initializer_list<std::string_view> parts,
                                 IfExists if_exists = IfExists::replace);

/// The whole content of a regular file. Errors: missing, unreadable.
Result<std::string> read_file(const std::filesystem::path& path);

}  // namespace launchsafe::store
