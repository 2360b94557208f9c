// A scene changed key by key, where only the last one need be valid.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>
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

/// A scene on its way. Changes may be valid only after others, or together with them: whichever a scene
/// cannot have yet waits for those that follow.
class ChangedScene {
 public:
  explicit ChangedScene(scene::SceneFile scene) : scene_(std::move(scene)) {}
  void apply(const Change& change);
  /// Adds to the notes of the scene.
  void note(std::string note) { scene_.notes.push_back(std::move(note)); }
  /// The scene has all changes and is valid.
  bool complete() const { return waiting_.empty(); }
  /// Why the first waiting change is none that the scene can have. Only where not complete().
  scene::InputError error() const;
  const scene::SceneFile& scene() const { return scene_; }
  scene::SceneFile take() { return std::move(scene_); }

 private:
  struct Waiting {
    Change change;
    scene::InputError error;
  };
  std::optional<scene::InputError> try_to(const Change& change);
  void retry();
  void try_all();

  scene::SceneFile scene_;
  std::vector<Waiting> waiting_;
};

}  // namespace launchsafe::study
