// The scene that the cases of a study start from.
#pragma once

#include "launchsafe/study/accuracy_record.hpp"
#include "study_keys.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// Scene keys with other values than the scene has: a table of the study file, by its name there. No node:
/// none.
struct OverrideTable {
  std::string name;
  const toml::node* node = nullptr;
};

/// Reads and validates a study and its scene from its table; `file` is named in errors. A study with more
/// cases is refused. Nothing is computed.
scene::Expected<study::StudyFile> read_study_table(const StudySource& source, const std::string& file,
                                                   std::size_t most_cases);

/// Reads a scene by its path from the study file's folder; the fault of a missing one is at `key`.
scene::Expected<scene::SceneFile> read_named_scene(const std::string& name,
                                                   const std::filesystem::path& folder,
                                                   const std::string& key, const scene::Place& place);

/// Reads the scene that the study names, then the overrides, in their order, then the constants of a
/// calibration, then the numerics that a tolerance (K, of T max) picks from an accuracy record. `record`
/// becomes that of the study, if it names one.
study::Fault settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides,
                          study::StudyFile& study, std::optional<study::AccuracyRecord>& record);

/// The acceptances of a table: those of scene keys go to the study's scene, those of its own keys beside what
/// it states. Needs the overrides.
study::Fault settle_acceptances(const toml::table& table, const StudyKeys& keys, study::StudyFile& study);

}  // namespace launchsafe::kinds
