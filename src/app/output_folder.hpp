// The folders that a user names for results, and that of a study: whether it may be used, and what becomes of
// an earlier study's report in it.
#pragma once

#include "console.hpp"

namespace launchsafe::app {

/// Makes the folder where it does not exist. A message when it cannot be made or written to, so that a run
/// finds out before it computes rather than after.
std::optional<std::string> prepare_output_folder(const path& folder);

using NamedTexts = std::vector<report::TextFile>;

/// Where files of these names lie in a folder, as the user named it.
std::vector<std::string> places_of(const path& folder, const NamedTexts& texts);

/// Writes files into a folder, which is made where there is none: all of them, or none where one may not be
/// written, which ends the command. "wrote scene.toml", or "kept" of what is there with this content.
std::vector<std::string> write_where_absent(const path& folder, const NamedTexts& texts, Console& console);

using store::StudyRecord;

/// The manifest of a study: its input is the model version, what the study file says, without remarks and in
/// sorted order, and the scene with what the study sets in it. Every case follows from these.
store::Manifest study_manifest(const study::StudyFile& file, int jobs);

/// Whether both ask the same of the same model.
bool same_study(const store::Manifest& one, const store::Manifest& other);

/// Whether the folder holds cases that a study stored.
bool holds_store(const path& folder);

/// Why the results of a study may not go into the folder: it holds those of a different study and `update` is
/// not set, or files of somebody else under names that the report needs. Nothing is changed.
std::optional<std::string> obstacle_in_folder(const path& folder, const kinds::Kind& kind,
                                              const store::Manifest& manifest, bool update);

/// Removes what killed processes left of report files that they were writing; while no other process is at
/// work in the folder.
void remove_leftovers(const path& folder);

}  // namespace launchsafe::app
