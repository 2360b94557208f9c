// A scene with other values of some keys, as studies ask for them.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// Equal but for the round-off of units.
bool same_number(double a, double b);
/// Likewise; numbers of lists too.
bool same_value(const scene::Value& a, const scene::Value& b);

/// A scene key with a new value.
struct Change {
  std::string key;  ///< of the scene
  scene::Value value;
  std::string text;       ///< the value as people read it
  std::string study_key;  ///< for faults: where in the study it was asked for
  scene::Place place;     ///< likewise
};

/// What gap.model may be where gaps that close are not judged: there they are judged on one launch, which a
/// gap that closes has not.
inline constexpr const char* only_reservoir =
    "gap.model = \"reservoir\"; a study of kind critical-gap judges gaps that close";

/// The scene with all changes, which need be valid only together (scene::with_keys), or why it cannot have
/// them, at the change that this is about. `may_close`: they may make its gap one that closes.
scene::Expected<scene::SceneFile> with_changes(const scene::SceneFile& scene,
                                               const std::vector<Change>& changes, bool may_close = false);

}  // namespace launchsafe::study
