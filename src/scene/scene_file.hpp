// What readers share: text of input files before it is parsed, what no reader may see of it; and the parts
// that reading a scene file is made of, its materials, and what is wrong with it.
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
/// With small letters (ASCII).
std::string lower_case(std::string_view text);

/// "a, b" as its parts between separators, without blanks around them; at least one, which may be empty.
std::vector<std::string_view> parts_of_list(std::string_view text, char separator = ',');

/// Throws the fault of the first byte of a text that is no UTF-8, or a NUL, with its line.
void check_encoding(std::string_view text, const std::string& file);

/// Throws that of a dotted key of so many parts that its nested tables would exhaust the stack of whoever
/// walks through them. What is in a text or a comment counts too.
void check_points(std::string_view toml, const std::string& file);

/// A file of studies/materials.
struct BuiltInText {
  std::string file, text;  ///< "comp-b.toml"
};
const std::vector<BuiltInText>& built_in_materials();

/// A file of studies/constants, the default first.
const std::vector<BuiltInText>& built_in_constants();

/// The value that the constants of a scene file give a key of the scene; null where they give none, or where
/// the file has its own: a measured curve, a steel, a charge with its ignition temperature.
const Value* constant_of(const SceneFile& file, const std::string& key);
/// Holds bodies at the charge, of which the file says nothing, as its constants do. The paper's method has
/// one velocity a place, and its faces stay bonded.
void hold_by_constants(const SceneFile& file, Scene& scene);

/// The keys of [load], under their names in that table.
std::vector<Key<Load>> load_keys();

/// Makes the scene of materials that the bodies name. The material that bodies of a law are of becomes the
/// scene's material of that law: its numbers are given values of the law's keys, and the scene's own stand
/// above them. Where bodies of one law are of several materials, that one is the law's that is called so,
/// else the first body's; the others keep their names and numbers. Of explosives there may be one. Throws: a
/// name that no material has, a second explosive, keys of a law of which no body says which material they
/// mean, keys of [kinetics] in the scene's own file that differ from the charge's material, and a file of a
/// material that cannot be read.
void use_materials(SceneFile& file, Scene& scene);

/// Reads all [interface.NAME] of a file, in the order of their names, and the places of these,
/// "interface.<name>", and of "interface.<name>.<key>". Throws the fault of a table that is none, a key that
/// does not exist, a value out of range.
void read_interfaces(const toml::table& root, const std::string& file, Scene& scene,
                     std::map<std::string, Place>& places);

/// Whether two bodies share more than an edge of their surfaces.
bool share_a_face(const Scene& scene, const Body& a, const Body& b);

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

/// A fault of a scene, at the place where the user gave the key.
inline InputError fault_at(const SceneFile& file, const std::string& key, std::string_view found,
                           std::string_view allowed, std::string_view suggestion = {}) {
  return error_at(place_of_key(file, key), key, found, allowed, suggestion);
}

// Each throws the first fault that it finds.

/// Edges of bodies, or a bore around the axis, that nearly but not quite lie at one place: closer than a
/// tenth of a cell, which no grid shows. The message has the value that makes them one.
void check_near_edges(const SceneFile& file);
/// A charge with an end that bodies do not cover all over, bodies that nothing holds, and a chamber that the
/// drawing leaves unclear.
void check_support(const SceneFile& file);
/// A body that does not touch the charge, keys of an interface that are missing or would do nothing, sliding
/// in a form that has none.
void check_interfaces(const SceneFile& file);
/// Points of a measured curve of which no curve can be built.
void check_curve(const SceneFile& file);
/// What stands beside a measured curve, and the end of the load.
void check_load(const SceneFile& file);

}  // namespace launchsafe::scene
