// Pressure of steel as Eq. 18 to 20 of the paper have it, which no step computes by itself.
#pragma once

#include "launchsafe/materials/mie_gruneisen.hpp"

#include <algorithm>

namespace launchsafe::test_support {

/// p_H (Pa) at compression mu = rho/rho0 - 1 > -1: Eq. 19 with s - 1; linear in tension, constant beyond the
/// guard.
inline double hugoniot_pressure(const materials::MieGruneisenParameters& m, double mu) {
  const double modulus = m.density * m.sound_speed * m.sound_speed;
  if (mu < 0.0) return modulus * mu;
  const double bounded = std::min(mu, materials::largest_compression(m));
  const double denominator = 1.0 - (m.slope - 1.0) * bounded;
  return modulus * bounded * (1.0 + bounded) / (denominator * denominator);
}

/// e_H (J/kg) = p_H mu/(2 rho0 (1 + mu)); 0 in tension.
inline double hugoniot_energy(const materials::MieGruneisenParameters& m, double mu) {
  const double compressed = std::clamp(mu, 0.0, materials::largest_compression(m));
  return hugoniot_pressure(m, compressed) * compressed / (2.0 * m.density * (1.0 + compressed));
}

/// Pressure (Pa) at compression mu and specific internal energy (J/kg): p_H + Gamma rho0 (e - e_H).
inline double mie_gruneisen_pressure(const materials::MieGruneisenParameters& m, double mu, double energy) {
  return hugoniot_pressure(m, mu) + m.gruneisen * m.density * (energy - hugoniot_energy(m, mu));
}

}  // namespace launchsafe::test_support
