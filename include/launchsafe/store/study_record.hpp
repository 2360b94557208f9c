// manifest.json of a folder: what was asked, of which program, and the files of the report there, by which
// they are known as this program's own. Nothing else is ever replaced, whatever its name.
#pragma once

#include "launchsafe/store/case_file.hpp"

#include <nlohmann/json_fwd.hpp>

namespace launchsafe::store {

inline constexpr const char* manifest_name = "manifest.json";

/// A text in a file of its own, such as a record for other studies.
struct TextFile {
  std::string name, text;
  bool operator==(const TextFile&) const = default;
};

/// A file as it was written.
struct WrittenFile {
  std::string name;  ///< in its folder
  std::string sha256;
  bool operator==(const WrittenFile&) const = default;
};

/// What manifest.json says.
struct StudyRecord {
  Manifest manifest;
  std::vector<WrittenFile> files = {};  ///< of the report; none while it is not finished
  /// While a report is written: what may be there of it, and of the one before.
  std::vector<WrittenFile> unfinished = {};
  bool complete = true;       ///< the report lacks no picture
  std::string failures = {};  ///< digest of what failed, which a report tells too
  std::string study =
      {};  ///< the study file as in a command; empty in older manifests, and of a safety report

  /// Programs that made launches of the study, see `program_of`; none while the report is not finished.
  std::vector<std::string> programs = {};

  /// These, unless the program of the manifest made all launches.
  std::vector<std::string> other_programs() const;
  /// All that may be there, in alphabetical order.
  std::vector<std::string> names() const;
};

enum class FileState {
  absent,
  ours,    ///< as this program wrote it
  edited,  ///< of a name that this program gave a file, with other content
  foreign  ///< never written by this program
};
FileState state_of(const std::filesystem::path& folder, const StudyRecord& record, const std::string& name);

/// What manifest.json of it is.
nlohmann::ordered_json to_json(const StudyRecord& record);

/// Reads manifest.json. Errors: missing, unreadable, corrupt (also somebody else's file of that name).
Result<StudyRecord> read_study_record(const std::filesystem::path& folder);

/// The same of a folder that a report is to be written into: without manifest.json a record without an input.
/// Errors: conflict (manifest.json is none of ours), unreadable.
Result<StudyRecord> record_of_report(const std::filesystem::path& folder);

/// Writes manifest.json; never over one that is not ours.
MaybeError write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// Writes the files of a report, then manifest.json with their digests. A kill between leaves a manifest that
/// knows all files by what they were and will be. Edited files get another name, NAME.edited-1; those of the
/// report before that this one lacks go to `earlier-1`. Returns remarks on both. Errors: conflict (a file of
/// somebody else; nothing was changed), write_failed, unreadable.
Result<std::vector<std::string>> write_report_files(const std::filesystem::path& folder, StudyRecord record,
                                                    const std::vector<TextFile>& files);

/// Moves what is there under these names to a new folder in it, `earlier-N`. Returns that; empty for no
/// names. Errors: write_failed.
Result<std::filesystem::path> set_aside(const std::filesystem::path& folder,
                                        const std::vector<std::string>& names);

/// Files with the content that was recorded. Errors: corrupt (a file that is missing or has another content).
Result<std::vector<TextFile>> read_as_written(const std::filesystem::path& folder,
                                              const std::vector<WrittenFile>& files);

}  // namespace launchsafe::store
