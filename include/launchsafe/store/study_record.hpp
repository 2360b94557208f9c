// manifest.json of a study's folder: what was asked, of which program, and the files of the report.
#pragma once

#include "launchsafe/store/manifest.hpp"
#include "launchsafe/store/own_files.hpp"
#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::store {

/// What manifest.json says.
struct StudyRecord {
  Manifest manifest;
  std::vector<WrittenFile> files = {};  ///< of the report; none while the study is not finished
  bool complete = true;                 ///< the report lacks no picture
  std::string failures = {};            ///< digest of what failed, which a report tells too
  std::string study = {};               ///< the study file as in a command; empty in older manifests
};

/// Reads manifest.json. Errors: missing, unreadable, corrupt (also somebody else's file of that name).
Result<StudyRecord> read_study_record(const std::filesystem::path& folder);

/// Writes manifest.json; never over one that is not ours.
MaybeError write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// Files as they are now; those that are not there are left out.
std::vector<WrittenFile> record_files(const std::filesystem::path& folder,
                                      const std::vector<std::string>& names);

/// Whether every file has the content that was recorded.
bool files_unchanged(const std::filesystem::path& folder, const std::vector<WrittenFile>& files);

}  // namespace launchsafe::store
