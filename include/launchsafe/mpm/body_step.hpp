// One step of all particles of a body: read the grid, move, update the material, give to the next grid.
#pragma once

#include "launchsafe/mpm/particles.hpp"
#include "launchsafe/mpm/transfer.hpp"
#include "launchsafe/scene/scene.hpp"

namespace launchsafe::mpm {

/// What a step fixes for all bodies.
struct StepContext {
  double dt = 0;            ///< s
  double read_origin = 0;   ///< window of the grid that is read, m
  double write_origin = 0;  ///< window of the grid that is written, m
  double pic_fraction = 0;  ///< share of the grid velocity in the particle velocity
  bool axisymmetric = true;
  materials::Relaxation<double> relaxation{};  ///< for the charge
};

/// What a step adds to the energy balance (J per radian, or per metre) and to the limiters (particle-steps).
struct StepTotals {
  Pack internal{0.0}, plastic{0.0}, viscous{0.0}, crack{0.0}, pic_loss{0.0}, centred_kinetic{0.0};
  Pack tension_cutoff{0.0}, hugoniot_guard{0.0}, crack_at_bound{0.0}, off_grid{0.0};
};

void advance(SteelBody& body, const scene::Steel& steel, Grid& grid, const StepContext& context,
             StepTotals& totals);
void advance(ChargeBody& body, const scene::Charge& charge, Grid& grid, const StepContext& context,
             StepTotals& totals);

/// Gives a body at rest and free of stress to an empty grid: mass and momentum only.
void scatter_initial(const Kinematics& body, Grid& grid, const StepContext& context);

/// Largest squared longitudinal sound speed and largest |v_x| + |v_r| of a body.
struct Speeds {
  double sound_squared = 0;  ///< m2/s2
  double particle = 0;       ///< m/s
};
Speeds speeds_of(const SteelBody& body, const scene::Steel& steel);
Speeds speeds_of(const ChargeBody& body, const scene::Charge& charge);

}  // namespace launchsafe::mpm
