// Mie-Grueneisen equation of state on a linear Hugoniot (paper Eq. 18-20; Eq. 19 corrected to s - 1).
#pragma once

#include "launchsafe/math/pack.hpp"

#include <limits>

namespace launchsafe::materials {

/// p = p_ref(mu) + Gamma rho0 (e - e_ref(mu)) at compression mu = rho/rho0 - 1 > -1 and specific internal
/// energy e (J/kg), Eq. 18. In compression the reference is the Hugoniot, p_ref = rho0 c0^2 mu (1 + mu)/(1 -
/// (s - 1) mu)^2 with e_ref = p_ref mu/(2 rho0 (1 + mu)); in tension the line p_ref = rho0 c0^2 mu with e_ref
/// = 0.
///
/// Why the energy counts in tension too. The law is an expansion about a reference curve with Gamma rho
/// constant. At mu = 0 both curves have p_ref = 0, dp_ref/dmu = rho0 c0^2, e_ref = 0 and de_ref/dmu = 0
/// (e_ref goes with mu^2), so p and its slope at constant energy are continuous there for any e. Without
/// Gamma rho0 e in tension p would jump by it, and steel that was heated and unloads would chatter about mu =
/// 0.
///
/// Monotone: the isentropic modulus is (1 + mu) dp/dmu|_e + Gamma p/(1 + mu), at mu = 0 rho0 c0^2 + Gamma^2
/// rho0 e from either side, positive for every e > -(c0/Gamma)^2: at any temperature. Further into tension
/// work done adds to e. Along the isentrope from rest, dp/dw = -rho0 c0^2/w^2 - Gamma p in w = v/v0 = 1/(1 +
/// mu), so the tension is largest where p = -rho0 c0^2/(Gamma w^2): for steel 36.6 GPa at w = 1.65, ten times
/// its spall strength. Beyond, it falls to 0 like that of any solid pulled apart.
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

/// One step of mie_gruneisen_compress by the mean of its pressures, with one division. Written out, with x =
/// mu1 between 0 and its bound, a = 1 - (s - 1) x and h = dv/2,
///   p1 = C/a^2 + G e1,  C = rho0 c0^2 min(mu1, bound) (1 + (1 - Gamma/2) x),  G = Gamma rho0,
///   e1 - e0 = [heat - h (p0 + C/a^2 + G e0)]/(1 + h G),  h = (mu0 - mu1)/D,  D = 2 rho0 (1 + mu0)(1 + mu1),
/// and a^2 (D + (mu0 - mu1) G) is the common denominator of 1/a^2 and 1/(1 + h G).
template <class Real>
MieGruneisenState<Real> compress_by_mean_pressure(const MieGruneisenParameters& m, Real mu0, Real p0,
                                                  Real energy0, Real mu1, Real heat) {
  using math::max;
  using math::min;
  const double modulus = m.density * m.sound_speed * m.sound_speed;
  const Real g(m.gruneisen * m.density);
  const Real below = min(mu1, Real(largest_compression(m))), x = max(below, Real(0.0));
  const Real a = Real(1.0) - Real(m.slope - 1.0) * x, square = a * a;
  const Real cold = Real(modulus) * below * (Real(1.0) + Real(1.0 - 0.5 * m.gruneisen) * x);
  const Real change = mu0 - mu1;
  const Real twice = Real(2.0 * m.density) * (Real(1.0) + mu0) * (Real(1.0) + mu1);
  const Real implicit = twice + change * g;
  const Real per_all = Real(1.0) / (square * implicit);
  const Real gained = (heat * twice - change * (p0 + g * energy0)) * square - change * cold;
  const Real energy1 = energy0 + gained * per_all;
  return {cold * implicit * per_all + g * energy1, energy1};
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

/// Isentropic bulk modulus rho dp/drho|_s (Pa) with constant Gamma rho; 0 beyond the largest tension that the
/// law bears (see MieGruneisenParameters).
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
  const Real above = Real(1.0) + x;
  const Real energy_slope = (hugoniot_slope * x / above + hugoniot / (above * above)) / Real(2.0 * m.density);
  // dp/dmu at constant energy; of the line in tension rho0 c0^2, which the first also gives at x = 0.
  const Real slope = hugoniot_slope - Real(m.gruneisen * m.density) * energy_slope;
  // Beyond the guard the density still counts as that at the guard.
  const Real density_ratio = select(mu < Real(0.0), Real(1.0) + mu, above);
  // de/drho|_s = p/rho^2, and mu = rho/rho0 - 1.
  return max(density_ratio * slope + Real(m.gruneisen) * pressure / density_ratio, Real(0.0));
}

}  // namespace launchsafe::materials
