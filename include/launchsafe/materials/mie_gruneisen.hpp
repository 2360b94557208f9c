// Mie-Grueneisen equation of state on a linear Hugoniot (paper Eq. 18-20; Eq. 19 corrected to s - 1).
#pragma once

#include "launchsafe/math/pack.hpp"

namespace launchsafe::materials {

struct MieGruneisenParameters {
  double density = 7830.0;      ///< rho0, kg/m3 [P]
  double sound_speed = 4610.0;  ///< c0, m/s [P]
  double slope = 1.73;          ///< s [P]
  double gruneisen = 1.67;      ///< Gamma at rho0; Gamma rho is constant [P]
  /// Largest compression mu as a fraction of the Hugoniot pole 1/(s - 1). Beyond it the law has no meaning:
  /// the pressure is continued at the bound's value and the state is reported (`mie_gruneisen_is_valid`).
  double pole_fraction = 0.9;
};

/// Largest valid compression mu = rho/rho0 - 1.
inline double largest_compression(const MieGruneisenParameters& m) {
  return m.slope > 1.0 ? m.pole_fraction / (m.slope - 1.0) : 1e3;
}

/// True where the compression lies below the guarded pole.
template <class Real>
auto mie_gruneisen_is_valid(const MieGruneisenParameters& m, Real mu) {
  return mu <= Real(largest_compression(m));
}

/// Hugoniot pressure p_H (Pa), linear in tension. mu = rho/rho0 - 1 > -1.
template <class Real>
Real hugoniot_pressure(const MieGruneisenParameters& m, Real mu) {
  using math::max;
  using math::min;
  using math::select;
  const double modulus = m.density * m.sound_speed * m.sound_speed;
  const Real bounded = min(max(mu, Real(0.0)), Real(largest_compression(m)));
  const Real denominator = Real(1.0) - Real(m.slope - 1.0) * bounded;
  const Real compressed = Real(modulus) * bounded * (Real(1.0) + bounded) / (denominator * denominator);
  return select(mu < Real(0.0), Real(modulus) * mu, compressed);
}

/// Hugoniot energy e_H (J/kg) = p_H mu / (2 rho0 (1 + mu)); 0 in tension.
template <class Real>
Real hugoniot_energy(const MieGruneisenParameters& m, Real mu) {
  using math::max;
  const Real compressed = max(mu, Real(0.0));
  return hugoniot_pressure(m, compressed) * compressed / (Real(2.0 * m.density) * (Real(1.0) + compressed));
}

/// Pressure (Pa) at compression mu and specific internal energy e (J/kg), Eq. 18. In tension rho0 c0^2 mu.
template <class Real>
Real mie_gruneisen_pressure(const MieGruneisenParameters& m, Real mu, Real energy) {
  using math::select;
  const Real hugoniot = hugoniot_pressure(m, mu);
  const Real thermal = Real(m.gruneisen * m.density) * (energy - hugoniot_energy(m, mu));
  return select(mu < Real(0.0), hugoniot, hugoniot + thermal);
}

template <class Real>
struct MieGruneisenState {
  Real pressure;  ///< Pa
  Real energy;    ///< J/kg
};

/// Change from (p0, e0, mu0) to mu1 with de = -1/2 (p0 + p1) dv + heat, v = 1/rho; linear in e, solved
/// exactly. `heat` (J/kg) is what the step dissipated, plastic work for steel.
template <class Real>
MieGruneisenState<Real> mie_gruneisen_compress(const MieGruneisenParameters& m, Real mu0, Real p0,
                                               Real energy0, Real mu1, Real heat) {
  using math::select;
  const Real dv = (mu0 - mu1) / (Real(m.density) * (Real(1.0) + mu0) * (Real(1.0) + mu1));
  const Real hugoniot = hugoniot_pressure(m, mu1);
  const Real stiffness = select(mu1 < Real(0.0), Real(0.0), Real(m.gruneisen * m.density));
  const Real cold = hugoniot - stiffness * hugoniot_energy(m, mu1);
  const Real energy1 =
      (energy0 + heat - Real(0.5) * dv * (p0 + cold)) / (Real(1.0) + Real(0.5) * dv * stiffness);
  return {cold + stiffness * energy1, energy1};
}

/// Isentropic bulk modulus rho dp/drho|_s (Pa) with constant Gamma rho.
template <class Real>
Real mie_gruneisen_bulk_modulus(const MieGruneisenParameters& m, Real mu, Real pressure) {
  using math::max;
  using math::min;
  using math::select;
  const double modulus = m.density * m.sound_speed * m.sound_speed;
  const Real x = min(max(mu, Real(0.0)), Real(largest_compression(m)));
  const Real d = Real(1.0) - Real(m.slope - 1.0) * x;
  const Real hugoniot = Real(modulus) * x * (Real(1.0) + x) / (d * d);
  const Real hugoniot_slope =
      Real(modulus) * ((Real(1.0) + Real(2.0) * x) * d + Real(2.0 * (m.slope - 1.0)) * x * (Real(1.0) + x)) /
      (d * d * d);
  const Real one_plus = Real(1.0) + x;
  const Real energy_slope =
      (hugoniot_slope * x / one_plus + hugoniot / (one_plus * one_plus)) / Real(2.0 * m.density);
  const Real gamma_rho = Real(m.gruneisen * m.density);
  // de/drho|_s = p/rho^2, and mu = rho/rho0 - 1.
  const Real compressed =
      one_plus * (hugoniot_slope - gamma_rho * energy_slope) + Real(m.gruneisen) * pressure / one_plus;
  return select(mu < Real(0.0), (Real(1.0) + mu) * Real(modulus), compressed);
}

}  // namespace launchsafe::materials
