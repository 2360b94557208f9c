// manifest.json of a folder: input and program of a study, and the files of the report there. It marks the
// folder as one that this program made.
#pragma once

#include "launchsafe/store/case_file.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::store {

inline constexpr const char* manifest_name = "manifest.json";

/// A text in a file of its own, such as a record for other studies.
struct TextFile {
  std::string name, text;
  bool operator==(const TextFile&) const = default;
};

/// The content of manifest.json.
struct StudyRecord {
  Manifest manifest = {};
  std::vector<std::string> files = {};  ///< of the report; none while it is not finished
  bool complete = true;                 ///< no case failed, and the report lacks no picture
  std::string study = {};               ///< the study file as in a command; empty of a safety report

  /// Programs that made launches of the study, see `program_of`; none while the report is not finished.
  std::vector<std::string> programs = {};
  /// These, unless the program of the manifest made all launches.
  std::vector<std::string> other_programs() const;
};

nlohmann::ordered_json to_json(const StudyRecord& record);

/// Reads manifest.json. Errors: missing, unreadable, corrupt (also somebody else's file of that name).
StudyRecord read_study_record(const std::filesystem::path& folder);

/// The record of a folder for results; in an empty folder a record without an input. Errors: conflict
/// (manifest.json is none of ours, or there is none and the folder is not empty), unreadable.
StudyRecord record_of_folder(const std::filesystem::path& folder);

/// Writes manifest.json. Errors: write_failed.
void write_study_record(const std::filesystem::path& folder, const StudyRecord& record);

/// Writes the files of a report into a folder of this program, then manifest.json, and removes files of the
/// report before that this one lacks. Errors: those of `record_of_folder`, write_failed.
void write_report_files(const std::filesystem::path& folder, StudyRecord record,
                        const std::vector<TextFile>& files);

}  // namespace launchsafe::store
