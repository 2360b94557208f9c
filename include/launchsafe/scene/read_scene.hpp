// Every key of a scene file: name, dimension, range, default, standing and meaning, bound to the member of
// the Scene that it fills; and a scene from a file: read, completed, validated; changed key by key; listed
// and written back. Reading, documenting, sweeping and storing scenes all go through the one list of keys.
#pragma once

#include "launchsafe/scene/named_material.hpp"

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

/// A valid scene, and what in it was said rather than assumed.
struct SceneFile {
  Scene scene;
  std::string file;                         ///< as named by the user
  std::filesystem::path folder;             ///< what relative paths in it start from
  std::map<std::string, Given> given;       ///< scene keys that the user set, or a material that he named
  std::vector<NamedMaterial> materials;     ///< that bodies may be of, besides the shipped ones
  std::vector<std::string> body_materials;  ///< of each body, as the user named it
  std::vector<Source> sources;              ///< of the scene's own values
  std::map<std::string, Place> places;      ///< of "body.<name>.x", "observation_point.<name>.r", ...
  std::vector<std::string> notes;           ///< on words of earlier versions, a line each
};

/// Where the user gave a key; the file as a whole if it is a default.
Place place_of_key(const SceneFile& file, const std::string& key);

/// Reads and validates a scene file; its curve file is read too. Nothing is computed. Never throws.
Expected<SceneFile> read_scene(const std::filesystem::path& file);
/// The same from text; `file` is named in errors, and relative paths start from its folder.
Expected<SceneFile> parse_scene(std::string_view text, const std::filesystem::path& file);

/// Throws that of a `load.expected_velocity` that differs by more than 5 % from what the load gives the
/// projectile as one rigid body at the exit, or at the end of the launch where there is none. Files are
/// checked when they are read, and again under what a study sets; cases of its axes are other launches on
/// purpose.
void check_expected_velocity(const SceneFile& file);

/// The key of a scene by dotted name; "body.<name>.x", ".r" or ".material" of a body that the scene has, for
/// what holds the charge "interface.<name>.<key>" of a body that touches it, whether or not the scene has
/// that table, and "material.<name>.<key>" of a material that a body names.
Expected<KeyDescription> describe_key(const SceneFile& file, const std::string& name, const Place& place);

/// The value of a key that `describe_key` knows and that is no geometry. Numbers of an interface that are not
/// given are 0.
Value value_in(const SceneFile& file, const std::string& name);

/// A key with a new value, and where that was asked for.
struct KeyChange {
  std::string name;
  Value value;
  Place place;
};
/// The scene with some keys changed, validated anew: they need be valid only together, and lose no value to
/// each other. Keys that would contradict the new ones lose their given value: setting charge.face_friction
/// drops charge.crack_friction, setting kinetics.set drops the numbers of the law, ... `is_valid`: these
/// changes were found valid before, and are not validated again.
Expected<SceneFile> with_keys(const SceneFile& file, const std::vector<KeyChange>& changes,
                              bool is_valid = false);
/// The same of one key with the value as written: "0.1 mm", "true", "comp-b".
Expected<SceneFile> with_written_key(const SceneFile& file, const std::string& name, std::string_view written,
                                     const Place& place);

/// One key of a scene with its value.
struct ListedKey {
  std::string name;
  std::string value;  ///< as people read it
  Standing standing;  ///< `input` where the user gave it
  std::string sentence;
  Place place;           ///< where the user gave it
  std::string citation;  ///< where the value comes from; empty where nothing is said
};
/// The scene's own keys: those that do something, and those that the user gave.
std::vector<ListedKey> list_keys(const SceneFile& file);

/// The whole scene as TOML in SI, every key that does something written, measured curves included: reads back
/// to exactly the same scene, if its materials are those of a file. Equal texts are equal scenes, whatever
/// file they came from.
std::string to_toml(const Scene& scene);

/// Throws the first fault that makes a scene unfit to compute (see the places of the file for where).
void validate(const SceneFile& file);

}  // namespace launchsafe::scene
