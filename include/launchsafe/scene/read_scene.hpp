// Every key of a scene file: name, dimension, range, default, standing and meaning, bound to the member of
// the Scene that it fills; and a scene from a file: read, completed, validated; changed key by key; listed
// and written back. Reading, documenting, sweeping and storing scenes all go through the one list of keys.
// Every function that reads throws the first InputError that it finds.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

namespace launchsafe::scene {

// --- keys ---

/// Keys of the scene itself, in the order in which they are applied.
const std::vector<Key<Scene>>& scene_keys();
/// The part of a computation that another value of a scene's key changes; the mechanics for any other key,
/// such as "body.wall.x".
ActsOn acts_on(std::string_view scene_key);
/// Keys of one [[body]].
const std::vector<Key<Body>>& body_keys();

/// A key and its default as people read it; an empty default for a key that must be given.
struct DocumentedKey {
  KeyDescription description;
  std::string default_text;
};
/// All keys of a scene file, those of its tables as "body.x", "interface.NAME.friction" and
/// "observation_point.x".
std::vector<DocumentedKey> describe_keys();

// --- scenes from files ---

/// All numbers of a material: a TOML file that a body names by its path, or one that ships.
struct NamedMaterial {
  std::string name;   ///< as bodies name it
  std::string law;    ///< the word of its law, such as "charge"
  std::string title;  ///< for people
  Place place;
  std::map<std::string, Given> values;  ///< by the scene's key, such as "charge.density"
};
/// The materials that the program brings along, by name; texts in studies/materials.
const std::vector<NamedMaterial>& shipped_materials();

struct Constants;

/// A valid scene, and what in it was said rather than assumed.
struct SceneFile {
  Scene scene;
  std::string file;                            ///< as named by the user
  std::filesystem::path folder;                ///< what relative paths in it start from
  std::map<std::string, Given> given;          ///< scene keys that the user set, or a material that he named
  std::vector<NamedMaterial> materials;        ///< that were read from files
  std::vector<std::string> body_materials;     ///< of each body, as the user named it
  std::map<std::string, Place> places;         ///< of "body.<name>.x", "observation_point.<name>.r", ...
  std::shared_ptr<const Constants> constants;  ///< of every key that the file does not give; null: none
};

/// Reads and validates a scene file; its curve file is read too. Nothing is computed.
SceneFile read_scene(const std::filesystem::path& file);
/// The same from text; `file` is named in errors, and relative paths start from its folder.
SceneFile parse_scene(std::string_view text, const std::filesystem::path& file);

/// Throws the fault of a `load.expected_velocity` that differs by more than 5 % from what the load gives the
/// projectile as one rigid body at the exit, or at the end of the launch where there is none. Files are
/// checked when they are read, and again under what a study sets; cases of its axes are other launches on
/// purpose.
void check_expected_velocity(const SceneFile& file);

/// Where the user gave a key; the file as a whole if it is a default.
Place place_of_key(const SceneFile& file, const std::string& key);

/// Where activation temperature, frequency factor and heat of the charge come from, as people read it: the
/// charge's material, or keys of the scene or a study, each with file and line.
std::string kinetics_origin(const SceneFile& file);

/// The key of a scene by dotted name; "body.<name>.x", ".r" or ".material" of a body that the scene has, and
/// for what holds the charge "interface.<name>.<key>" of a body that touches it, whether or not the scene has
/// that table.
KeyDescription describe_key(const SceneFile& file, const std::string& name, const Place& place);
/// The value of such a key. Numbers of an interface that are not given are 0.
Value value_in(const SceneFile& file, const std::string& name);

/// A key with a new value, and where that was asked for.
struct KeyChange {
  std::string name;
  Value value;
  Place place;
};
/// The scene with some keys changed, validated anew: they need be valid only together. Keys that would
/// contradict the new ones lose their given value: setting load.shape drops the numbers of the other shape.
/// `is_valid`: these changes were found valid before, and are not validated again.
SceneFile with_keys(const SceneFile& file, const std::vector<KeyChange>& changes, bool is_valid = false);

/// One key of a scene with its value.
struct ListedKey {
  std::string name;
  std::string value;  ///< as people read it
  std::string sentence;
};
/// The scene's own keys: those that do something, and those that the user gave.
std::vector<ListedKey> list_keys(const SceneFile& file);

/// The whole scene as TOML in SI, every key that does something written, measured curves included: reads back
/// to exactly the same scene. Equal texts are equal scenes, whatever file they came from.
std::string to_toml(const Scene& scene);

/// Names of the bodies, no charges themselves, that touch a charge.
std::vector<std::string> bodies_at_the_charge(const Scene& scene);
/// What holds the charge, as people read it: one line a body that touches it, with what that assumes.
struct InterfaceText {
  std::string body, condition, assumes;
};
std::vector<InterfaceText> describe_interfaces(const Scene& scene);

}  // namespace launchsafe::scene
