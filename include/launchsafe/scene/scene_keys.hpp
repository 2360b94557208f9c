// Every key of a scene file: name, dimension, range, default, standing and meaning, bound to the member of
// the Scene that it fills. This is the only list: reading, documenting, sweeping and storing scenes all go
// through it.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

namespace launchsafe::scene {

/// Keys of the scene itself, in the order in which they are applied.
const std::vector<Key<Scene>>& scene_keys();
/// The role of a key of the scene. One that is none of these, such as "body.wall.x", changes everything.
keys::Role role_of(std::string_view key);
/// Whether a number of a law does anything in a scene. Those that came later than what is stored are written
/// only where they do.
bool is_of_use(const KeyDescription& number, const Scene& scene);
/// Those of the charge's bottom among them: gap and air, friction and stations.
std::vector<Key<Scene>> surface_keys();
/// Keys of one [[body]].
const std::vector<Key<Body>>& body_keys();
/// Keys of one [[observation_point]].
const std::vector<Key<ObservationPoint>>& observation_point_keys();

/// A key and its default as people read it; an empty default for a key that must be given.
struct DocumentedKey {
  KeyDescription description;
  std::string default_text;
};
/// All keys of a scene file, those of its tables as "body.x", "interface.NAME.friction",
/// "observation_point.x" and "accept.key".
std::vector<DocumentedKey> describe_keys();

}  // namespace launchsafe::scene
