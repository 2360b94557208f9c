// Energy balance of a launch.
#pragma once

#include <algorithm>
#include <cmath>

namespace launchsafe::mpm {

/// Running sums since the start, J: per radian in a simulation, of the whole shell in results. Their meanings
/// are in run::energy_terms.
struct EnergyBalance {
  /// Centred in time: velocities are half a step away from stresses (leapfrog), and m v_old v_new/2 is what
  /// the discrete work balances.
  double kinetic = 0;
  double internal = 0, external = 0, body_force = 0, damping = 0, contact = 0;
  double plastic = 0, viscous = 0, crack = 0, hourglass = 0;
  double charge_work = 0, charge_friction = 0;

  /// What drift is measured against, > 0.
  double scale() const {
    return std::max({std::abs(kinetic) + std::abs(internal) + std::abs(damping) + std::abs(contact),
                     std::abs(external) + std::abs(body_force), 1e-300});
  }
  double drift() const { return (kinetic + internal + damping + contact - external - body_force) / scale(); }
};

}  // namespace launchsafe::mpm
