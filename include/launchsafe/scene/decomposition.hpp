// Decompositions of explosives whose numbers belong together, as data: what a flame lives on after the
// ignition.
#pragma once

#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/scene/named_material.hpp"

#include <string>
#include <vector>

namespace launchsafe::scene {

/// The word of combustion.kinetics for the charge's own numbers, those that decide ignition.
inline constexpr const char* effective_kinetics = "effective";

/// Keys of one [decomposition.NAME].
const std::vector<Key<Decomposition>>& decomposition_keys();

/// Those that the program brings along; texts in studies/materials.
const std::vector<Decomposition>& shipped_decompositions();

/// The tables [decomposition.NAME] of a file that ships. Faults: a number that is missing or out of range,
/// and those of sources.
Expected<std::vector<Decomposition>> read_decompositions(const toml::table& root, const std::string& file,
                                                         const std::vector<Decomposition>& known);

/// What the flame of a scene lives on (combustion.kinetics), with the charge's T1 and T2: the charge's own
/// kinetics, or E/R, Z and Q of a decomposition. Its heat is never more than the charge's, which is what
/// burning releases.
materials::KineticsParameters flame_kinetics(const Scene& scene);

}  // namespace launchsafe::scene
