// Johnson-Cook flow stress with radial return (paper Eq. 16-17).
#pragma once

#include "launchsafe/math/deviator.hpp"

#include <limits>

namespace launchsafe::materials {

struct JohnsonCookParameters {
  double a = 792e6;                     ///< A, Pa [P]
  double b = 510e6;                     ///< B, Pa [P]
  double n = 0.26;                      ///< hardening exponent [P]
  double c = 0.014;                     ///< rate sensitivity [P]
  double m = 1.03;                      ///< thermal softening exponent [P]
  double reference_rate = 1.0;          ///< 1/s [A]
  double room_temperature = 298.0;      ///< K [A]
  double melting_temperature = 1793.0;  ///< K [P]
  double shear_modulus = 80e9;          ///< G, Pa [L]
  double specific_heat = 460.0;         ///< J/(kg K) [P]
  double taylor_quinney = 0.9;          ///< share of the plastic work that becomes heat [A]
  double conductivity = 38.0;           ///< W/(m K) [L]
};

/// Flow stress (Pa) at plastic strain >= 0, plastic strain rate (1/s) and temperature (K). Below the
/// reference rate the rate factor is 1; at and above melting the flow stress is 0.
template <class Real>
Real johnson_cook_flow_stress(const JohnsonCookParameters& k, Real plastic_strain, Real plastic_rate,
                              Real temperature) {
  using math::log;
  using math::max;
  using math::min;
  using math::pow;
  using math::select;
  const Real homologous =
      min(max((temperature - Real(k.room_temperature)) / Real(k.melting_temperature - k.room_temperature),
              Real(0.0)),
          Real(1.0));
  const Real softening = Real(1.0) - pow(homologous, Real(k.m));
  const Real rate_factor = Real(1.0) + Real(k.c) * log(max(plastic_rate / Real(k.reference_rate), Real(1.0)));
  return (Real(k.a) + Real(k.b) * pow(plastic_strain, Real(k.n))) * rate_factor * softening;
}

template <class Real>
struct JohnsonCookReturn {
  math::Deviator<Real> stress;    ///< Pa
  Real plastic_strain_increment;  ///< 1
  Real plastic_work;              ///< J/m3 of current volume
};

/// Radial return of a trial deviator: finds the plastic strain increment d >= 0 with
/// q_trial - 3 G d = flow_stress(strain + d, d/dt, T). The left side falls and the right side rises with d,
/// so the root is unique and lies in [0, q_trial/(3G)]; it is found by bisection-guarded secant steps, to
/// 1e-9 of q_trial. Explicit in the temperature, which changes by far less than the yield stress in one step.
/// NaN where stress, strain or temperature is: steel of unknown strength is not elastic.
template <class Real>
[[gnu::noinline]]  // rare beside the elastic step, which stays small without it
JohnsonCookReturn<Real>
johnson_cook_return(const JohnsonCookParameters& k, math::Deviator<Real> trial, Real plastic_strain,
                    Real temperature, Real dt) {
  using math::any;
  using math::max;
  using math::min;
  using math::select;
  const Real three_g = Real(3.0 * k.shear_modulus);
  const Real q = math::von_mises(trial);
  const auto excess = [&](Real d) {
    return q - three_g * d - johnson_cook_flow_stress(k, plastic_strain + d, d / dt, temperature);
  };
  Real low(0.0), high = q / three_g;
  Real f_low = excess(low);
  const auto yields = f_low > Real(0.0);
  const auto known = (f_low > Real(0.0)) | (f_low <= Real(0.0));  // false where anything is not a number
  if (!any(yields | !known)) return {trial, Real(0.0), Real(0.0)};
  Real f_high = excess(high);
  Real d(0.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Real close_enough = Real(1e-9) * q;
    const auto open =
        yields & ((high - low) > Real(1e-10) * high) & (f_low > close_enough) & (-f_high > close_enough);
    if (!any(open)) break;
    // Secant inside the bracket, every third time a bisection so that the bracket always shrinks.
    const Real secant = low + (high - low) * f_low / (f_low - f_high);
    d = iteration % 3 == 2 ? Real(0.5) * (low + high) : secant;
    const Real f = excess(d);
    const auto still_yields = f > Real(0.0);
    low = select(open & still_yields, d, low);
    f_low = select(open & still_yields, f, f_low);
    high = select(open & !still_yields, d, high);
    f_high = select(open & !still_yields, f, f_high);
  }
  const Real increment =
      select(yields, low + (high - low) * f_low / max(f_low - f_high, Real(1e-300)), Real(0.0));
  // Of molten steel nothing remains, and round-off must not leave less than nothing.
  const Real remaining = max(q - three_g * increment, Real(0.0));
  const Real scale = select(yields, remaining / max(q, Real(1e-300)), Real(1.0));
  const Real unknown(std::numeric_limits<double>::quiet_NaN());
  return {select(known, scale, unknown) * trial, select(known, increment, unknown),
          select(known, increment * remaining, unknown)};
}

}  // namespace launchsafe::materials
