// Decomposition kinetics in words: their numbers, and how fast explosive heats itself by them.
#pragma once

#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/scene/scene.hpp"

#include <string>

namespace launchsafe::report {

/// "runs away by itself in 341 ms from 519 K and in 29.3 ms from 550 K": adiabatic, specific heat in J/(kg
/// K). 519 K is where the air of a gap takes the skin of the 155 mm shell, 550 K what cook-off tests go to.
std::string runaway_text(const materials::KineticsParameters& kinetics, double specific_heat);

/// A sentence: which decomposition the flame of a coupled run lives on, and which decides ignition.
std::string flame_kinetics_note(const scene::Scene& scene);

}  // namespace launchsafe::report
