// What a safety report rests on: the folders that studies left, read and checked.
#pragma once

#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/run/case_result.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"
#include "launchsafe/study/record_domain.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace launchsafe::report {

/// What a finished study tells, by the tables that it has: verdicts of one launch or of a few cases, verdicts
/// over axes with several values, ...
enum class Tells { nothing, launch, sweep, models, accuracy, sensitivity, stability };

/// One study.
struct StudyEvidence {
  std::string label;  ///< "S1", in the order in which the user named them
  std::filesystem::path folder;
  store::StudyRecord record;
  std::string kind, title;
  Row asked;               ///< the keys of the study file: true, or the text that they have
  scene::SceneFile scene;  ///< what was simulated, with what the study sets
  Row study;               ///< study.json; null while the study is not finished
  Tells tells = Tells::nothing;
  std::map<std::string, std::string> drawings = {};  ///< its pictures as it drew them, SVG by file name
  std::vector<store::RunRecord> runs = {};           ///< of the folder's results file; none without one
  /// What is not as in the scene of the report's main study; values that somebody accepts as "accept".
  std::vector<study::Difference> differences = {};

  bool finished() const { return study.is_object(); }
  /// That makes it again, or goes on with it.
  std::string command() const;
  /// The rows of a table of study.json; none where it has no such table.
  const Row& rows(const std::string& table) const;
};

/// One case of a study that gives verdicts.
struct CaseEvidence {
  std::string label;              ///< "496 MPa, 30 um, 1 mm"; of a sweep its place on the axes
  const Row* critical = nullptr;  ///< its row of the table of cases
  std::string others = {};        ///< of a sweep its place on the axes behind the first two
  std::vector<const Row*> verdicts = {};
  std::map<std::string, double> values = {};  ///< SI, by scene key: in what its launch may differ
  std::string status = {};                    ///< how its mechanical run ended

  /// Temperatures of a run that was cut off are those of a part of the launch.
  bool completed() const { return status == "completed"; }
};
std::vector<CaseEvidence> cases_of(const StudyEvidence& study);

/// The value of a scene key that takes one number, SI; of a measured load its peak.
double own_value(const StudyEvidence& study, const std::string& key);

/// The scene of a case. Errors: values that the study's scene cannot have.
scene::Expected<scene::SceneFile> scene_of(const StudyEvidence& study, const CaseEvidence& judged);

/// K by which a temperature that is integrated again on a stored trace may differ from the study's.
inline constexpr double same_temperature = 0.01;

/// All of it. There is at least one study.
struct SafetyEvidence {
  std::vector<StudyEvidence> studies;
  /// The stored runs of the main study's launch, as far as they were kept, by the case.
  std::map<std::string, run::MechanicsResult> mechanics = {};
  /// The finished study that tells that; nullptr without one.
  const StudyEvidence* find(Tells what) const;
  /// The one that the report is about: that of a launch, or else the first that is not finished or sweeps, or
  /// the first.
  const StudyEvidence& main() const;
};

/// Reads the folders of studies. Every file that a manifest lists must be there as it was written. Errors, a
/// message each: no study there, a file that was edited or is missing, a model version other than this
/// program's or another study's, a damaged case, verdicts without the code of their reason as an earlier
/// program wrote them, a SAFE that its own numbers or its stored run contradict, two studies of a kind that
/// tell the same, studies of different shells, studies that bound the critical gap of one launch differently.
store::Result<SafetyEvidence> read_safety_evidence(const std::vector<std::filesystem::path>& folders);

/// Refuses studies that judge the same launch, with the same numerics, by different lower bounds of its
/// critical gap: they do not rest on the same records or statements. Where numerics or any other key of the
/// scene differs the bounds may. Not compared are critical gaps beyond the end of a search, and a comparison
/// whose result is the record of other models, which it cannot use itself.
store::MaybeError check_agreement(const SafetyEvidence& evidence);

}  // namespace launchsafe::report
