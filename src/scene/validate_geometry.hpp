// What the bodies of a scene must satisfy together, so that what was drawn is what was meant.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <optional>

namespace launchsafe::scene {

/// Edges of bodies, or a bore around the axis, that nearly but not quite lie at one place: closer than a
/// tenth of a cell, which no grid shows. The message has the value that makes them one.
std::optional<InputError> fault_of_near_edges(const SceneFile& file);

/// A charge whose bottom does not bear on a body all over, bodies that nothing holds, and a chamber that the
/// drawing leaves unclear.
std::optional<InputError> fault_of_support(const SceneFile& file);

}  // namespace launchsafe::scene
