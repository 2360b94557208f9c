// The parts that reading a scene file is made of: its materials, its constants, and what is wrong with it.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {

template <class List, class Value>
bool contains(const List& list, const Value& value) {
  return std::ranges::find(list, value) != list.end();
}

/// In quotation marks; nothing for nothing.
inline std::string in_quotes(const std::string& text) { return text.empty() ? text : '"' + text + '"'; }

/// The value of a key; null where a map has it not.
template <class Map>
const typename Map::mapped_type* find_in(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& each : all) names.push_back(each.name);
  return names;
}

/// Without blanks, tabs and line ends at its ends.
std::string_view without_blanks_around(std::string_view text);
/// "a, b" as its parts between separators, without blanks around them; at least one, which may be empty.
std::vector<std::string_view> parts_of_list(std::string_view text, char separator = ',');

/// A file of studies/materials, or of studies/constants.
struct BuiltInText {
  std::string file, text;  ///< "comp-b.toml"
};
const std::vector<BuiltInText>& built_in_materials();
const std::vector<BuiltInText>& built_in_constants();

/// The material of a law that bodies name by its file or as one that ships; null where it is the usual one.
const NamedMaterial* named_material_of(const SceneFile& file, std::string_view law);
/// Makes the scene of materials that the bodies name: their numbers become given values of the law's keys,
/// and the scene's own stand above them. Throws: a name that no material has, two materials of one law, keys
/// of [kinetics] in the scene's own file that differ from the charge's material, a file that cannot be read.
void use_materials(SceneFile& file, Scene& scene);

/// The value that the constants of a scene file give a key of the scene; null where they give none, or where
/// the file has its own: a measured curve, a steel, a charge with its ignition temperature.
const Value* constant_of(const SceneFile& file, const std::string& key);
/// Holds bodies at the charge, of which the file says nothing, as its constants do. The paper's method has
/// one velocity a place, and its faces stay bonded.
void hold_by_constants(const SceneFile& file, Scene& scene);

/// The keys of [load], under their names in that table.
std::vector<Key<Load>> load_keys();
/// Keys of one [interface.NAME], and of one [[observation_point]].
const std::vector<Key<Interface>>& interface_keys();
const std::vector<Key<ObservationPoint>>& observation_point_keys();

/// The extent of a body along one axis.
struct Axis {
  const char* name;
  double Body::*begin;
  double Body::*end;
};
inline constexpr Axis axis_x{"x", &Body::x_begin, &Body::x_end}, axis_r{"r", &Body::r_begin, &Body::r_end};

/// How far two bodies overlap along an axis, m; less than 0 for a distance.
inline double overlap(const Body& a, const Body& b, const Axis& along) {
  return std::min(a.*along.end, b.*along.end) - std::max(a.*along.begin, b.*along.begin);
}
/// Whether two bodies share more than an edge of their surfaces.
bool share_a_face(const Scene& scene, const Body& a, const Body& b);

/// All keys that are written, one a line: "PREFIX.KEY = VALUE".
template <class Owner>
std::string lines_of(const std::string& prefix, const std::vector<Key<Owner>>& keys, const Owner& owner) {
  std::string text;
  for (const Key<Owner>& key : keys)
    if (!key.is_written || key.is_written(owner))
      text += fmt::format("{}{} = {}\n", prefix, key.name, exact_toml(key, key.get(owner)));
  return text;
}

/// A fault of a scene, at the place where the user gave the key.
inline InputError fault_at(const SceneFile& file, const std::string& key, std::string_view found,
                           std::string_view allowed, std::string_view suggestion = {}) {
  return error_at(place_of_key(file, key), key, found, allowed, suggestion);
}

// Each throws the first fault that it finds.

/// Bodies that overlap, nearly touch, or are held by nothing; a charge with an open end; a chamber that the
/// drawing leaves open.
void check_geometry(const SceneFile& file);
/// Points of a measured curve of which no curve can be built.
void check_curve(const SceneFile& file);
/// The time of the muzzle exit, where its travel is stated; none where the projectile never comes that far.
void find_exit(Scene& scene);
/// What stands beside a measured curve, and the end of the load.
void check_load(const SceneFile& file);
/// The first fault that makes a scene unfit to compute (see the places of the file for where).
void validate(const SceneFile& file);

}  // namespace launchsafe::scene
