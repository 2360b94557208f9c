// Materials, and how bodies hold the charge, as data: [material.NAME] and [contact.NAME] in a scene or in a
// file of materials, and those that ship with the program; [interface.NAME] of a scene, for the body of that
// name and the charge. Each number may say where it comes from.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

namespace launchsafe::scene {

/// A value that a file gives, and where.
struct Given {
  Place place;
  Value value;
  bool of_material = false;  ///< by the material of a body, and not by the scene itself
};

/// All numbers of a material, whose name bodies refer to.
struct NamedMaterial {
  std::string name;
  std::string law;    ///< the word of its law, such as "charge"
  std::string title;  ///< for people
  std::string like;   ///< name of the material that gives what is not given here
  Place place;
  std::map<std::string, Given> values;  ///< by the scene's key, such as "charge.density"
  std::vector<Source> sources;          ///< of these keys
};

/// A contact whose name interfaces refer to.
struct NamedContact {
  std::string name;
  std::string title;            ///< for people
  Interface faces;              ///< without a body
  std::vector<Source> sources;  ///< of its keys
};

/// Activation energy, frequency factor and heat of one reaction of order zero, which belong together. They
/// ship with the program, and files of users have none.
struct Decomposition {
  std::string name;                        ///< a word of combustion.kinetics
  std::string title;                       ///< of which explosive, for people
  materials::KineticsParameters kinetics;  ///< E/R, Z and Q; the rest is unused
  std::vector<Source> sources;             ///< of its keys, as a material names them without "kinetics."
};

struct NamedMaterials {
  std::vector<NamedMaterial> materials;
  std::vector<NamedContact> contacts;
  std::vector<Decomposition> decompositions;
};

/// The key of a scene that names a file of materials and contacts.
const KeyDescription& material_file_key();
/// What [material.NAME] says beside the numbers of its law.
const std::vector<Key<NamedMaterial>>& material_keys();
/// Keys of one [interface.NAME].
const std::vector<Key<Interface>>& interface_keys();
/// Keys of one [contact.NAME], and that of an interface which names a contact.
const std::vector<Key<NamedContact>>& contact_keys();
const KeyDescription& contact_of_interface_key();
/// A number's key as a material has it: "density" for "charge.density"; others keep their table.
std::string key_in_material(std::string_view law, std::string_view scene_key);

/// The materials and contacts that the program brings along, by name; texts in studies/materials.
const std::vector<NamedMaterial>& shipped_materials();
const std::vector<NamedContact>& shipped_contacts();

/// The tables [material.NAME] of a file; none if it has none. `known`: materials of other files, which these
/// may be like, and whose names they must not take. Throws: a name that is taken, an unknown law or key, a
/// number that is neither given nor that of another material, a material that is like itself, and those of
/// sources.
std::vector<NamedMaterial> read_materials(const toml::table& root, const std::string& file,
                                          const std::vector<NamedMaterial>& known);

/// The tables [contact.NAME] of a file; none if it has none. `known`: contacts of other files, whose names
/// these must not take. Throws: a name that is taken, a key that does not exist, a value out of range, those
/// of sources.
std::vector<NamedContact> read_contacts(const toml::table& root, const std::string& file,
                                        const std::vector<NamedContact>& known);

/// Throws the fault of the first key of a file of materials that is no table of it.
void check_material_tables(const toml::table& root, const std::string& file);
/// What a file of materials has. A shipped file gives what it ships; others must not take its names. Faults:
/// those of `read_materials` and `read_contacts`, a key beside the tables, a scene or a study.
Expected<NamedMaterials> read_material_file(const std::filesystem::path& file);

/// Keys of [[source]], and of the sources of a material.
const std::vector<Key<Source>>& source_keys();
/// The tables "source" of a table; none if it has none. Throws: a key that is not among `known`, one with two
/// sources, a source without words.
std::vector<Source> read_sources(const toml::table& table, const std::vector<std::string>& known,
                                 const std::string& file);
/// The source of a key; none where nothing is said.
const Source* source_of(const std::vector<Source>& sources, const std::string& key);
/// Takes a key away from its source: its value is another one.
void forget_source(std::vector<Source>& sources, const std::string& key);

/// Names of the bodies, no charges themselves, that touch a charge.
std::vector<std::string> bodies_at_the_charge(const Scene& scene);

/// What holds the charge, as people read it: one line a body that touches it, with what that assumes.
struct InterfaceText {
  std::string body, condition, assumes;
};
std::vector<InterfaceText> describe_interfaces(const Scene& scene);

// Decompositions of explosives whose numbers belong together, as data: what a flame lives on after the
// ignition.

/// The word of combustion.kinetics for the charge's own numbers, those that decide ignition.
inline constexpr const char* effective_kinetics = "effective";

/// Keys of one [decomposition.NAME].
const std::vector<Key<Decomposition>>& decomposition_keys();

/// Those that the program brings along; texts in studies/materials.
const std::vector<Decomposition>& shipped_decompositions();

/// What the flame of a scene lives on (combustion.kinetics), with the charge's T1 and T2: the charge's own
/// kinetics, or E/R, Z and Q of a decomposition. Its heat is never more than the charge's, which is what
/// burning releases.
materials::KineticsParameters flame_kinetics(const Scene& scene);

}  // namespace launchsafe::scene
