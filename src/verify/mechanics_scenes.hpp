// The scenes that the checks of the mechanics simulate, and the computations themselves.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/verify/check.hpp"

#include <vector>

namespace launchsafe::verify::mechanics {

using Checks = std::vector<Check>;

// One file of computations each: waves, statics, launch, conduction.
Checks longitudinal_pulse();
Checks free_bar_pulse();
Checks plateau_in_a_bar();
Checks thick_walled_tube();
Checks setback_column();
Checks rigid_acceleration();
Checks free_flight();
Checks energy_of_a_pulse();
Checks lab_against_co_moving();
Checks semi_infinite_conduction();
Checks conduction_under_flux();
Checks conduction_keeps_heat();
Checks conduction_in_long_steps();

/// The 155 mm shell of model section 1.
scene::Scene shell_155(double cell_size);
/// A cylinder or strip of one material.
scene::Scene block(scene::BodyMaterial material, double length, double radius, double cell_size);
/// A pressure (Pa) that rises smoothly from 0 over `rise` (s) and then stays.
scene::Load ramp(double pressure, double rise, double duration);
/// Steel that never yields.
void make_elastic(scene::Scene& scene);

/// Runs to `end` (s) in equal steps no longer than the stable one at rest; returns the step (s).
double run_to(mpm::Simulation& simulation, double end);

/// Axial Cauchy stress of a steel or charge particle, tension positive, Pa.
double axial_stress(const mpm::SteelBody& body, std::size_t slot);
double axial_stress(const mpm::ChargeBody& body, std::size_t slot);

/// Observed order of convergence from two errors and the ratio of their mesh sizes (> 1).
double observed_order(double coarse_error, double fine_error, double ratio);

}  // namespace launchsafe::verify::mechanics
