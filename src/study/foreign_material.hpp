// Which constants of a scene's materials are not those of a calibration: of all materials of all bodies.
#pragma once

#include "launchsafe/scene/acceptance.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// Eight digits by which people tell whether something is still the same.
std::string short_digest(const std::string& text);

/// Adds the constants by which a body's material differs from that of the bodies that `share_place` with it
/// in the calibrated scene (null: of any body there), as "material.NAME.KEY". Those that both scenes have by
/// a key of the scene are compared by that.
void add_other_materials(const scene::Scene& scene, const scene::Scene& calibrated,
                         bool (*share_place)(const scene::Body&, const scene::Body&),
                         std::vector<scene::Implausible>& foreign);

/// Several constants of materials are one property, scene::foreign_material, with a digest of their values.
void summarise_materials(const scene::Scene& scene, std::vector<scene::Implausible>& foreign);

}  // namespace launchsafe::study
