// Which study a folder holds the results of: its manifest.json.
#pragma once

#include "launchsafe/store/manifest.hpp"
#include "launchsafe/store/own_files.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/study/study_file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::app {

/// What manifest.json says.
struct StudyRecord {
  store::Manifest manifest;
  std::vector<store::WrittenFile> files;  ///< of the report; none while the study is not finished
  bool complete = true;                   ///< the report lacks no picture
  std::string failures;                   ///< digest of what failed, which a report tells too
};

/// The manifest of a study: its input is the model version, what the study file says, without remarks and in
/// sorted order, and the scene with what the study sets in it. Every case follows from these.
store::Manifest study_manifest(const study::StudyFile& file, int jobs);

/// Whether both ask the same of the same model.
bool same_study(const store::Manifest& one, const store::Manifest& other);

/// Reads manifest.json. Errors: missing, unreadable, corrupt (also somebody else's file of that name).
store::Result<StudyRecord> read_study_record(const std::filesystem::path& folder);

/// The SHA-256 of manifest.json as it is; nothing where it cannot be read.
std::optional<std::string> manifest_digest(const std::filesystem::path& folder);

/// Writes manifest.json; never over one that is not ours.
store::MaybeError write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// Files as they are now; those that are not there are left out.
std::vector<store::WrittenFile> record_files(const std::filesystem::path& folder,
                                             const std::vector<std::string>& names);

/// Whether every file has the content that was recorded.
bool files_unchanged(const std::filesystem::path& folder, const std::vector<store::WrittenFile>& files);

}  // namespace launchsafe::app
