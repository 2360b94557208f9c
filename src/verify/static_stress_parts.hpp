// What the cases, the finite elements and the particles of the comparison of static stresses share.
#pragma once

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/verify/static_stress_comparison.hpp"

namespace launchsafe::verify {

/// x (m) of the bottom of the charge; without one, of the base.
double bottom_of(const scene::Scene& scene);

/// What is left of the shear modulus (Pa) when all Maxwell elements that relax have relaxed.
double static_shear_modulus(const materials::ViscoScramParameters& charge);

/// Runs the particles of a case in cells of `cell_size` (m) and takes the means.
ParticleMeans particle_means(const StaticCase& compared, double cell_size, const run::RunOptions& options);

}  // namespace launchsafe::verify
