// The half section of a shell at rest with its grid, as an SVG picture to scale.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <string>

namespace launchsafe::report {

/// Bodies in colours with their names in a legend, the lines of the grid, the axis of symmetry, the
/// observation points with their names, and both axes in mm. A slender shell with a charge is drawn whole,
/// and enlarged around the bottom of the charge. Names of points for which there is no room are left out, and
/// the picture counts them. Needs at least one body. No other program takes part, and equal scenes have equal
/// pictures.
std::string section_svg(const scene::Scene& scene);

}  // namespace launchsafe::report
