// Which files of a folder this program wrote, so that nothing else is ever replaced, whatever its name.
//
//   DIR/journal_of_files.jsonl   one line for every file that was written into DIR, only ever appended to
//
// A line is on disk before the file gets its name. So whatever is not as some line says is somebody else's,
// or ours and edited since; that a kill came between is no exception. Case files need no line: they prove by
// themselves what they are.
#pragma once

#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::store {

inline constexpr std::string_view own_files_name = "journal_of_files.jsonl";

/// A file as it was written.
struct WrittenFile {
  std::string name;  ///< in its folder
  std::string sha256;
};

enum class FileState {
  absent,
  ours,    ///< as this program wrote it
  edited,  ///< of a name that this program gave a file, with other content
  foreign  ///< never written by this program
};

/// What is known of the files in a folder at one moment.
class OwnFiles {
 public:
  /// Changes nothing; a folder that is not there has no files. Errors: conflict (the journal of files is none
  /// of ours), unreadable.
  static Result<OwnFiles> read(const std::filesystem::path& folder);

  FileState state_of(const std::string& name) const;
  /// Takes another record's word for a file that was written.
  void add(const WrittenFile& file) { digests_[file.name].insert(file.sha256); }
  bool knows(const WrittenFile& file) const;
  /// Those of the names that are there, as written or edited, in alphabetical order.
  std::vector<std::string> present() const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::set<std::string>> digests_;  ///< of every name, all that were ever written
};

/// Writes a file whole or not at all, as a new one or in the place of one of ours; one of the same content
/// stays. Errors: conflict (somebody else's, or edited; nothing was changed), write_failed, unreadable.
MaybeError write_own_file(const std::filesystem::path& path, std::string_view content);

/// Why a file of ours with this name could not be written. Changes nothing. Errors: conflict, unreadable.
MaybeError obstacle_to_own_file(const std::filesystem::path& path);

/// Takes another record's word for good. Errors: conflict, write_failed, unreadable.
MaybeError note_own_files(const std::filesystem::path& folder, const std::vector<WrittenFile>& files);

/// Gives files of ours that were edited another name, NAME.edited-1. Returns these names. Errors: as above.
Result<std::vector<std::string>> set_edited_aside(const std::filesystem::path& folder);

}  // namespace launchsafe::store
