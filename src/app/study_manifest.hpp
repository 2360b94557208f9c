// Which study a folder holds the results of.
#pragma once

#include "launchsafe/store/manifest.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/study/read_study.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace launchsafe::app {

/// The manifest of a study: its input is what the study file says, without remarks and in sorted order, and
/// every scene that follows from it.
store::Manifest study_manifest(const study::StudyFile& file, int jobs);

/// Why the results may not be written into the folder: it holds those of a different study.
std::optional<std::string> study_conflict(const std::filesystem::path& folder,
                                          const store::Manifest& manifest);

/// Writes manifest.json.
store::MaybeError write_study_manifest(const std::filesystem::path& folder, const store::Manifest& manifest);

}  // namespace launchsafe::app
