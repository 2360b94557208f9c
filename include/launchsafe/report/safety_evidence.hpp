// What a safety report rests on: the folders that studies left, read and checked.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::report {

/// One study.
struct StudyEvidence {
  std::string label;  ///< "S1", in the order in which the user named them
  std::filesystem::path folder;
  store::StudyRecord record;
  std::string kind, title;
  scene::SceneFile scene;                       ///< what was simulated, with what the study sets
  nlohmann::json study;                         ///< study.json; null while the study is not finished
  std::map<std::string, std::string> drawings;  ///< its maps as it drew them, SVG by file name
  std::vector<store::RunRecord> runs;           ///< of the folder's results file; none without one
  /// Scene keys whose values differ from those of the report's main study.
  std::vector<std::string> differences;
  bool finished() const { return study.is_object(); }
  /// That makes it again, or goes on with it.
  std::string command() const;
  /// The rows of a table of study.json; none where it has no such table.
  const nlohmann::json& rows(const std::string& member) const;
};

/// The scene of a verdict row: that of the study with the row's own load and defect. Nothing for a row
/// without a load.
std::optional<scene::Scene> scene_of(const StudyEvidence& study, const nlohmann::json& verdict);

/// K by which a temperature that is integrated again on a stored trace may differ from the study's.
inline constexpr double same_temperature = 0.01;

/// The stored mechanical run of one case of the main study.
struct CaseEvidence {
  std::string label;  ///< "496 MPa, 30 um, 1 mm"
  std::string file;   ///< in the study's folder
  bool present = false;
  run::MechanicsResult mechanics;
};

/// All of it. There is at least one study.
struct SafetyEvidence {
  std::vector<StudyEvidence> studies;
  std::vector<CaseEvidence> cases;
  /// The first study of a kind; nullptr without one.
  const StudyEvidence* find(const std::string& kind) const;
  /// The one that the report is about: of kind critical-gap, or sweep, or the first.
  const StudyEvidence& main() const;
};

/// Reads the folders of studies. Every file that a manifest lists must be there as it was written. Errors, a
/// message each: no study there, a file that was edited or is missing, a model version other than this
/// program's or another study's, a damaged case, a SAFE that its own numbers or its stored run contradict,
/// two studies of a kind, studies of different shells, studies that bound the critical gap of one launch
/// differently.
store::Result<SafetyEvidence> read_safety_evidence(const std::vector<std::filesystem::path>& folders);

}  // namespace launchsafe::report
