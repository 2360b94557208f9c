// How bodies hold the charge, as data: [contact.NAME] in a scene or a file of materials, and those that ship.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <string>
#include <vector>

namespace launchsafe::scene {

/// A contact whose name interfaces refer to.
struct NamedContact {
  std::string name;
  std::string title;            ///< for people
  Interface faces;              ///< without a body
  std::vector<Source> sources;  ///< of its keys
};

/// The key of a contact's title, and that of an interface which names a contact.
const std::vector<Key<NamedContact>>& contact_keys();
const KeyDescription& contact_of_interface_key();

/// The contacts that the program brings along; texts in studies/materials.
const std::vector<NamedContact>& shipped_contacts();

/// The tables [contact.NAME] of a file; none if it has none. `known`: contacts of other files, whose names
/// these must not take. Faults: a name that is taken, a key that does not exist, a value out of range, those
/// of sources.
Expected<std::vector<NamedContact>> read_contacts(const toml::table& root, const std::string& file,
                                                  const std::vector<NamedContact>& known);

}  // namespace launchsafe::scene
