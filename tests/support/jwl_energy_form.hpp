// JWL in its energy form, of which runs have the isentrope alone: for tests of that, and laws to try it on.
#pragma once

#include "launchsafe/materials/jwl.hpp"

#include <cmath>

namespace launchsafe::test_support {

/// Detonation products of Composition B [L]: a law that is none of an unreacted explosive.
inline materials::JwlParameters composition_b_products() {
  materials::JwlParameters parameters;
  parameters.a = 5.242e11;
  parameters.b = 7.678e9;
  parameters.r1 = 4.2;
  parameters.r2 = 1.1;
  parameters.omega = 0.34;
  parameters.initial_energy = 8.5e9;
  return parameters;
}

/// Pressure (Pa) at relative volume V > 0 and energy E (J per m3 of initial volume), Eq. 32.
inline double jwl_pressure(const materials::JwlParameters& m, double v, double energy) {
  return m.a * (1.0 - m.omega / (m.r1 * v)) * std::exp(-m.r1 * v) +
         m.b * (1.0 - m.omega / (m.r2 * v)) * std::exp(-m.r2 * v) + m.omega * energy / v;
}

/// E at V and temperature T (K) with rho0 Cv = `heat_capacity` (J/(m3 K)). With it the energy form and the
/// temperature form p = A exp(-R1 V) + B exp(-R2 V) + w rho0 Cv T/V are one law.
inline double jwl_energy_at_temperature(const materials::JwlParameters& m, double v, double heat_capacity,
                                        double temperature) {
  return materials::jwl_cold_energy(m, v) + heat_capacity * temperature;
}

}  // namespace launchsafe::test_support
