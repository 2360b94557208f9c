// What sliding layers in the charge take their heat from, of recorded particles.
#pragma once

#include "launchsafe/materials/friction_closure.hpp"
#include "launchsafe/mpm/body.hpp"

#include <array>

namespace launchsafe::run {

/// Adds a share of what a step did to a recorded particle.
inline void add(materials::SlidingStep& step, const mpm::Body<materials::Charge>& charge, std::size_t slot,
                double weight) {
  const mpm::ParticleFields& p = charge.particles;
  const auto deviator = [slot](const std::array<math::AlignedArray, 3>& change) {
    return math::Deviator<double>{change[0][slot], change[1][slot], change[2][slot]};
  };
  const math::Deviator<double> e = deviator(p.strain_change);
  step.pressure += weight * p.pressure[slot];
  step.volume_ratio += weight * p.volume_ratio[slot];
  step.strain = step.strain + weight * e;
  step.inelastic =
      step.inelastic + weight * (e - (0.5 / charge.law.shear_modulus()) * deviator(p.stress_change));
}

}  // namespace launchsafe::run
