// The tables [interface.NAME] of a scene file: how the body of that name and the charge hold each other.
#pragma once

#include "launchsafe/scene/named_material.hpp"

namespace launchsafe::scene {

struct SceneFile;

/// Keys of one [interface.NAME].
const std::vector<Key<Interface>>& interface_keys();

/// Whether two bodies share more than an edge of their surfaces.
bool share_a_face(const Scene& scene, const Body& a, const Body& b);

/// Names of the bodies, no charges themselves, that touch a charge.
std::vector<std::string> bodies_at_the_charge(const Scene& scene);

/// Reads all [interface.NAME] of a file, in the order of their names, the sources of values that they have of
/// a contact, by "interface.<name>.<key>", and the places of these and of "interface.<name>". Throws the
/// fault of a table that is none, a key that does not exist, a value out of range, a contact that is not
/// among `contacts`.
void read_interfaces(const toml::table& root, const std::string& file,
                     const std::vector<NamedContact>& contacts, Scene& scene, std::vector<Source>& sources,
                     std::map<std::string, Place>& places);

/// Throws faults that only the whole scene shows: a body that does not touch the charge, keys that are
/// missing or would do nothing, sliding in a form that has none.
void check_interfaces(const SceneFile& file);

/// What holds the charge, as people read it: one line a body that touches it, with what that assumes.
struct InterfaceText {
  std::string body, condition, assumes;
};
std::vector<InterfaceText> describe_interfaces(const Scene& scene);

}  // namespace launchsafe::scene
