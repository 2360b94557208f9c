// The cases of the studies of a safety report, and what the parts of its facts tell of them.
#pragma once

#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report::safety {

/// One case of a study that gives verdicts.
struct CaseEvidence {
  const StudyEvidence* study;
  const Row* critical;  ///< its row of the table of cases
  const Row* run;       ///< its row of the table of runs; that of the case where the study has none
  std::string label;    ///< "496 MPa, 30 µm, 1 mm"; of a sweep its place on the axes
  std::vector<const Row*> verdicts = {};
  std::vector<study::Change> changes = {};  ///< what it has otherwise than the study's scene

  bool is_own() const { return changes.empty(); }
  /// Temperatures of a run that was cut off are those of a part of the launch.
  bool completed() const { return text_of(*run, "status") == "completed"; }
  /// SI, of a scene key.
  double value(const std::string& key) const;
  scene::Expected<scene::SceneFile> scene() const { return study::with_changes(study->scene, changes); }
};
/// SI, of a scene key that takes one number; of a measured load its peak.
double own_value(const StudyEvidence& study, const std::string& key);
/// The study of gaps that close by which SAFE of a reservoir stays SAFE or not; a sweep of them, which looks
/// for no worst corner, leaves none. nullptr without any.
const StudyEvidence* held_against(const SafetyEvidence& evidence);

/// Whether it makes another launch, or computes it otherwise.
bool is_of_launch(const study::Difference& difference);

/// Verdicts stand case after case, in the order of the cases, each with all gaps of the study.
std::vector<CaseEvidence> cases_of(const StudyEvidence& study);

}  // namespace launchsafe::report::safety
