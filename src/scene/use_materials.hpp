// What bodies are made of: names of materials turned into laws with their numbers.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::scene {

/// The material of a name that a scene file knows: its own, or a shipped one.
const NamedMaterial* find_named_material(const SceneFile& file, const std::string& name);

/// Makes the scene of materials that the bodies name. The material that bodies of a law are of becomes the
/// scene's material of that law: its numbers are given values of the law's keys, and the scene's own stand
/// above them. Where bodies of one law are of several materials, that one is the law's that is called so,
/// else the first body's; the others keep their names and numbers. Of explosives there may be one. Faults: a
/// name that no material has, a second explosive, and keys of a law of which no body says which material they
/// mean.
std::optional<InputError> use_materials(SceneFile& file, Scene& scene);

/// "material.NAME.KEY" of the materials that bodies name, on their numbers in the file.
std::vector<Key<SceneFile>> keys_of_used_materials(const SceneFile& file);

}  // namespace launchsafe::scene
