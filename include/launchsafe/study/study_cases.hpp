// The cases of a study: complete, valid scenes.
#pragma once

#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/study_faults.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// A case of a valid scene, of another launch than the study's until somebody says so.
StudyCase case_of(std::string label, scene::SceneFile scene);

/// What to call a case by its place among those that are added.
using LabelOf = std::function<std::string(std::size_t index, const StudyCase& made)>;
/// The values of the axes (SI) of a case by its place.
using CoordinatesOf = std::function<std::vector<double>(std::size_t index)>;

/// Adds so many cases that have Study::axes otherwise than the study's scene. Every one is made once, to be
/// checked: the fault is that of the first that cannot be. Both functions are called from several threads.
Fault add_varied_cases(StudyFile& study, std::size_t count, const CoordinatesOf& coordinates_of,
                       const LabelOf& label_of);

/// "496 MPa, 30 µm, 1 mm", peak pressure, crack radius and flaw size, where nothing else varies; otherwise
/// every axis by its name: "peak_pressure 496 MPa, load.steepness 1.4".
std::string case_label(const Study& study, const StudyCase& made);

/// The full factorial of Study::axes, the last one fastest. `label_of`: instead of `case_label`.
Fault make_factorial(StudyFile& study,
                     const std::function<std::string(const StudyCase& made)>& label_of = {});

/// A fault at `key` where a study would have more cases than it may; `what` says how they come about.
Fault check_count(const StudyFile& study, const std::string& key, double count, const std::string& what);

/// The gaps of a study that judges some, where it has none itself: those of its scene.
Fault settle_gaps(StudyFile& study);

}  // namespace launchsafe::study
