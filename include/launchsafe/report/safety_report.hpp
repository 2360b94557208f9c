// A safety report: the folders that studies left; facts, which are rows of the studies and what was selected
// from them; and templates, which say what is said of them, where and in which digits.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report {

/// What a finished study tells, by the tables that it has, under the name that texts have for it: verdicts of
/// one launch or of a few cases, verdicts over axes with several values, ...
namespace tells {
inline const std::string nothing = "", launch = "launch", sweep = "sweep", accuracy = "accuracy",
                         sensitivity = "sensitivity", stability = "stability";
}

/// One study.
struct StudyEvidence {
  std::string label;  ///< "A", "B", ... in the order in which the user named them
  std::filesystem::path folder;
  store::StudyRecord record;
  std::string kind, title;
  toml::table asked;       ///< the study file
  scene::SceneFile scene;  ///< what was simulated, with what the study sets
  Row study;               ///< study.json, its pictures with their SVG; null while it is not finished
  std::string tells = tells::nothing;
  std::vector<std::string> differences = {};  ///< from the main study's scene: study::differences

  bool finished() const { return study.is_object(); }
  /// That makes it again, or goes on with it.
  std::string command() const;
  /// The rows of a table of study.json; none where it has no such table.
  const Row& rows(const std::string& table) const { return found_in(study, table); }
};

/// All of it. There is at least one study.
struct SafetyEvidence {
  std::vector<StudyEvidence> studies;
  /// The run of the main study's own launch, if it was kept, with the gaps that are in it as warm as their
  /// verdicts say.
  std::optional<run::CaseResult> stored = {};
  /// The finished study that tells that; nullptr without one.
  const StudyEvidence* find(const std::string& what) const;
  /// The one that the report is about: that of a launch, or else the first that is not finished or sweeps, or
  /// the first.
  const StudyEvidence& main() const;
};

/// One case of a study that gives verdicts.
struct CaseEvidence {
  const StudyEvidence* study;
  const Row* critical;  ///< its row of the table of cases
  const Row* run;       ///< its row of the table of runs; that of the case where the study has none
  std::string label;    ///< "496 MPa, 30 µm, 1 mm"; of a sweep its place on the axes
  std::vector<const Row*> verdicts = {};

  /// Whether it has nothing otherwise than the study's scene.
  bool is_own() const;
  /// Temperatures of a run that was cut off are those of a part of the launch.
  bool completed() const { return text_of(*run, "status") == "completed"; }
  /// SI, of a scene key.
  double value(const std::string& key) const;
};
/// SI, of a scene key that takes one number; of a measured load its peak.
double own_value(const StudyEvidence& study, const std::string& key);

/// Verdicts stand case after case, in the order of the cases, each with all gaps of the study.
std::vector<CaseEvidence> cases_of(const StudyEvidence& study);

/// Reads the folders of studies. Errors, a message each: no study there, a file that is missing or cannot be
/// read, another model version than this program's, a damaged case, two studies of a kind that tell the same,
/// studies of different shells.
store::Result<SafetyEvidence> read_safety_evidence(const std::vector<std::filesystem::path>& folders);

/// T max against gap of one launch in the colours of its verdicts, with its critical gap and what was
/// published. `tables`: rows of its study.
Plot verdict_plot(const Row& tables, const scene::Scene& scene);

/// Equal evidence makes equal files.
RenderedReport make_safety_report(const SafetyEvidence& evidence, const DrawingLimits& limits = {});

}  // namespace launchsafe::report
