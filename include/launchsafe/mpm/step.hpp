// Input of a step and the sums that it returns, in either formulation.
#pragma once

#include "launchsafe/math/pack.hpp"

namespace launchsafe::mpm {

using math::Mask;
using math::Pack;

/// Load and numerical parameters of a step.
struct StepInput {
  double dt = 0;              ///< s
  double pressure = 0;        ///< of the chamber, Pa
  double acceleration = 0;    ///< of the frame, m/s2
  double damping_factor = 1;  ///< fraction of the velocity that remains after damping
  double pic_fraction = 0;    ///< fraction of the grid velocity in the particle velocity
};

/// Sums over particles: energies (J per radian) and limiter events (particle-steps).
struct ParticleTotals {
  Pack internal{0.0}, hourglass{0.0}, plastic{0.0}, viscous{0.0}, crack{0.0}, pic_loss{0.0},
      centred_kinetic{0.0};
  Pack charge_work{0.0}, charge_friction{0.0};  ///< `internal` of the charge, heat of its layers
  Pack tension_cutoff{0.0}, pressure_guard{0.0}, crack_at_bound{0.0};
  Pack off_grid{0.0};   ///< particles outside the grid
  Pack distorted{0.0};  ///< particles whose cell is inverted or extremely stretched

  void add(const ParticleTotals& other);
};

/// Sums over nodes: energies (J per radian) and momenta (kg m/s per radian).
struct NodeTotals {
  Pack damping{0.0};            ///< taken out by damping in the step
  Pack lost_before{0.0};        ///< total-Lagrangian: taken out by damping and FLIP until the step's begin
  Pack old_momentum{0.0};       ///< axial, of the inertial mass, at the begin
  Pack inertial_momentum{0.0};  ///< the same with the velocity that the step moves by
  Pack momentum{0.0};           ///< axial, of the true mass, with that velocity

  void add(const NodeTotals& other);
};

/// Sums over contact of faces that can slide, per radian.
struct ContactTotals {
  double loss = 0;           ///< J, taken out by contact until the step's begin
  double way_back_loss = 0;  ///< J, correction of NodeTotals::lost_before, which is computed without contact
  double momentum = 0;       ///< kg m/s, axial, of the true mass; 0 where inertia is that
};

/// Axial motion of the centre of the inertial masses, on which forces act. It is not the centre of the true
/// masses where the inertia of some particles is scaled more than that of others.
struct BulkMotion {
  double inertia = 0;       ///< kg per radian
  double old_momentum = 0;  ///< kg m/s, at the begin of the step
  double momentum = 0;      ///< kg m/s, with the velocity that the step moves by
};

/// All sums of a step.
struct StepTotals {
  ParticleTotals particles;
  NodeTotals nodes;
  BulkMotion bulk;
  double chamber_flow = 0;  ///< volume by which the faces give way to the chamber's gas, m3/s
  ContactTotals contact;
};

inline void ParticleTotals::add(const ParticleTotals& other) {
  using Totals = ParticleTotals;
  for (const auto part : {&Totals::internal, &Totals::hourglass, &Totals::plastic, &Totals::viscous,
                          &Totals::crack, &Totals::pic_loss, &Totals::centred_kinetic, &Totals::charge_work,
                          &Totals::charge_friction, &Totals::tension_cutoff, &Totals::pressure_guard,
                          &Totals::crack_at_bound, &Totals::off_grid, &Totals::distorted})
    this->*part += other.*part;
}

inline void NodeTotals::add(const NodeTotals& other) {
  for (const auto part : {&NodeTotals::damping, &NodeTotals::lost_before, &NodeTotals::old_momentum,
                          &NodeTotals::inertial_momentum, &NodeTotals::momentum})
    this->*part += other.*part;
}

}  // namespace launchsafe::mpm
