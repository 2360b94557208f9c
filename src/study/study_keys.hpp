// Every key of a study file.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/study/read_study.hpp"

#include <limits>
#include <string>
#include <vector>

namespace launchsafe::study::detail {

/// Keys of the study itself.
const std::vector<scene::Key<Study>>& study_keys();
/// Keys of one [[reference]].
const std::vector<scene::Key<Reference>>& reference_keys();

/// One [[input]] as read.
struct InputText {
  std::string name;
  scene::KeyDescription key;  ///< of the scene
  math::Distribution::Kind kind = math::Distribution::Kind::uniform;
  double lower = -std::numeric_limits<double>::infinity();  ///< SI, as all of these
  double upper = std::numeric_limits<double>::infinity();
  double mean = not_a_number;
  double deviation = not_a_number;
  math::Distribution distribution() const;
};
/// Keys of an [[input]] that names a scene key; for documentation, of none.
std::vector<scene::Key<InputText>> input_keys(const scene::KeyDescription& scene_key);
std::string to_string(math::Distribution::Kind kind);

/// The kinds that a key or a table ("axes", "input", "settings", "case",
/// "reference", "cited_limit") belongs to; empty where
/// it belongs to every kind.
std::vector<StudyKind> kinds_of_key(const std::string& name);
/// The method of a sensitivity study that a key belongs to, if it belongs to one alone.
std::optional<SensitivityMethod> method_of_key(const std::string& name);

}  // namespace launchsafe::study::detail
