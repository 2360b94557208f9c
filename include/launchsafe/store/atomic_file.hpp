// Files that are there whole or not at all, also after a kill, a full disk or a power cut.
#pragma once

#include "launchsafe/store/result.hpp"

namespace launchsafe::store {

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

/// The names of what is in a folder, sorted, so that nothing depends on the file system's order; none of one
/// that cannot be read.
std::vector<std::string> list_folder(const std::filesystem::path& folder);

}  // namespace launchsafe::store
