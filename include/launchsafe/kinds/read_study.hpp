// A study from a file: what is asked of a scene, read and validated before anything is computed.
#pragma once

#include "launchsafe/study/study_file.hpp"

namespace launchsafe::kinds {

/// What the command line adds to a study file.
struct StudyRequest {
  /// K; the cheapest setting of the study's accuracy record whose T max is known to that replaces the
  /// scene's.
  std::optional<double> tolerance;
  std::size_t most_cases = study::largest_case_count;  ///< more are refused
};

/// Reads and validates a study file and its scene. Nothing is computed. Never throws.
scene::Expected<study::StudyFile> read_study(const std::filesystem::path& file,
                                             const StudyRequest& request = {});
/// The same from text; `file` is named in errors, and the scene is sought from its folder.
scene::Expected<study::StudyFile> parse_study(std::string_view text, const std::filesystem::path& file,
                                              const StudyRequest& request = {});

/// The published rows, [[reference]], of a file that studies name.
scene::Expected<std::vector<study::Reference>> read_references(const std::filesystem::path& file);

/// The keys of a study file and of its tables, "reference.gap" being that of one [[reference]], for
/// documentation. Sentences end with the kinds that a key belongs to, unless it belongs to all.
std::vector<scene::DocumentedKey> describe_study_keys();

}  // namespace launchsafe::kinds
