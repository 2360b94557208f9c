// Heat of sliding layers in the charge, from what a step did (paper Eq. 39).
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <array>
#include <cmath>

namespace launchsafe::run {

/// What a step did at a place: of a particle, or the mean over a part of the charge.
struct StepChange {
  double pressure = 0;                 ///< Pa at its end, compression positive
  double volume_ratio = 0;             ///< V at its end
  math::Deviator<double> strain{};     ///< increment
  math::Deviator<double> inelastic{};  ///< that less the elastic one, the change of S over 2 G

  /// Adds a share of what a step did to a recorded particle.
  void add(const mpm::Body<materials::Charge>& charge, std::size_t slot, double weight) {
    const mpm::ParticleFields& p = charge.particles;
    const auto deviator = [slot](const std::array<math::AlignedArray, 3>& change) {
      return math::Deviator<double>{change[0][slot], change[1][slot], change[2][slot]};
    };
    const math::Deviator<double> e = deviator(p.strain_change);
    pressure += weight * p.pressure[slot];
    volume_ratio += weight * p.volume_ratio[slot];
    strain = strain + weight * e;
    inelastic = inelastic + weight * (e - (0.5 / charge.law.shear_modulus()) * deviator(p.stress_change));
  }
};

/// Friction heat of the step by closure, J per m3 of the charge at rest, with localisation 1: mu_d p V times
/// the equivalent of the total strain increment, or of its inelastic part. None in tension.
inline std::array<double, trace::traced_closures> sliding_heat(double sliding_friction,
                                                               const StepChange& change) {
  const double pressure = change.pressure < 0.0 ? 0.0 : change.pressure;  // NaN stays one
  const double sliding = sliding_friction * pressure * change.volume_ratio;
  return {sliding * math::equivalent_strain(change.strain),
          sliding * math::equivalent_strain(change.inelastic)};
}

}  // namespace launchsafe::run
