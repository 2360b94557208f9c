// Mie-Grueneisen equation of state on a linear Hugoniot (paper Eq. 18-20; Eq. 19 corrected to s - 1).
#pragma once

#include "launchsafe/math/pack.hpp"

#include <limits>

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

/// True where the compression lies below the guarded pole and belongs to a density above 0.
template <class Real>
auto mie_gruneisen_is_valid(const MieGruneisenParameters& m, Real mu) {
  return (mu <= Real(largest_compression(m))) & (mu > Real(-1.0));
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

namespace detail {

/// Change of density, as a share of it, up to which a step may use the mean of its two pressures, and the
/// change in each part of one that goes beyond.
inline constexpr double small_density_change = 0.02;
inline constexpr double density_change_per_part = 0.005;
/// Parts at most; beyond a change of density by e^10 they grow with it.
inline constexpr int most_parts = 2000;

/// One step of mie_gruneisen_compress by the mean of its pressures.
template <class Real>
MieGruneisenState<Real> compress_by_mean_pressure(const MieGruneisenParameters& m, Real mu0, Real p0,
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

/// The step in parts of equal density ratio. NaN for a density that is none (mu1 <= -1).
template <class Real>
[[gnu::noinline, gnu::cold]]  // sound runs change a density by less in a step
MieGruneisenState<Real>
compress_in_parts(const MieGruneisenParameters& m, Real mu0, Real p0, Real energy0, Real mu1, Real heat) {
  using math::abs;
  using math::exp;
  using math::largest;
  using math::log;
  using math::select;
  const Real change = log((Real(1.0) + mu1) / (Real(1.0) + mu0));
  const double needed = largest(select(abs(change) < Real(1e300), abs(change), Real(0.0)));  // 0 for NaN
  const int parts =
      1 + static_cast<int>(math::min(needed / density_change_per_part, static_cast<double>(most_parts)));
  const Real factor = exp(change * Real(1.0 / parts));
  MieGruneisenState<Real> state{p0, energy0};
  Real mu = mu0;
  for (int part = 1; part <= parts; ++part) {
    const Real next = part == parts ? mu1 : (Real(1.0) + mu) * factor - Real(1.0);
    state = compress_by_mean_pressure(m, mu, state.pressure, state.energy, next, heat * Real(1.0 / parts));
    mu = next;
  }
  const Real nothing(std::numeric_limits<double>::quiet_NaN());
  const auto has_density = (mu0 > Real(-1.0)) & (mu1 > Real(-1.0));
  return {select(has_density, state.pressure, nothing), select(has_density, state.energy, nothing)};
}

}  // namespace detail

/// Change from (p0, e0, mu0) to mu1 with de = -1/2 (p0 + p1) dv + heat, v = 1/rho; linear in e, solved
/// exactly. `heat` (J/kg) is what the step dissipated, plastic work for steel. Beyond a small change of
/// density, in parts.
template <class Real>
MieGruneisenState<Real> mie_gruneisen_compress(const MieGruneisenParameters& m, Real mu0, Real p0,
                                               Real energy0, Real mu1, Real heat) {
  using math::abs;
  using math::any;
  using math::select;
  const MieGruneisenState<Real> state = detail::compress_by_mean_pressure(m, mu0, p0, energy0, mu1, heat);
  const auto large = abs(mu1 - mu0) > Real(detail::small_density_change) * (Real(1.0) + mu0);
  if (!any(large)) return state;
  const MieGruneisenState<Real> parts = detail::compress_in_parts(m, mu0, p0, energy0, mu1, heat);
  return {select(large, parts.pressure, state.pressure), select(large, parts.energy, state.energy)};
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
