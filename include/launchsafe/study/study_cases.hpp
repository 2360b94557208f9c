// The cases of a study: complete, valid scenes.
#pragma once

#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/study_faults.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// A case of a valid scene, of another launch than the study's until somebody says so.
StudyCase case_of(std::string label, scene::SceneFile scene);

/// The same scene without the places of its geometry: there may be many cases, and nothing can be wrong with
/// a geometry that no case changes.
scene::SceneFile without_places(scene::SceneFile scene);

/// Puts cases into StudyFile::cases that differ in the keys of Study::axes.
class CaseMaker {
 public:
  explicit CaseMaker(StudyFile& study);
  void add(std::string label, std::vector<double> coordinates, scene::SceneFile scene);

 private:
  bool is_own(const StudyCase& made) const;

  StudyFile& study_;
  double own_peak_;              ///< Pa
  std::vector<double> own_;      ///< of the axes in the study's scene, SI
  std::vector<bool> condition_;  ///< of the axes: another value is another launch
};

/// What to call a case of a factorial; `changes` is "peak_pressure 496 MPa, crack_radius 30 um".
using LabelOf = std::string (*)(const StudyCase& made, const std::string& changes);
/// "496 MPa, 30 um, 1 mm": peak pressure, crack radius, flaw size.
std::string launch_label(const StudyCase& made, const std::string& changes);

/// The full factorial of Study::axes, the last one fastest.
Fault make_factorial(StudyFile& study, LabelOf label);

/// A fault at `key` where a study would have more cases than it may; `what` says how they come about.
Fault check_count(const StudyFile& study, const std::string& key, double count, const std::string& what);

/// The gaps of a study that judges some, where it has none itself: those of its scene.
Fault settle_gaps(StudyFile& study);

}  // namespace launchsafe::study
