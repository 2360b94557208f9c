// Thermal conductivity of air by temperature.
#pragma once

#include <cmath>

namespace launchsafe::materials {

/// Thermal conductivity (W/(m K)) of air at temperature T > 0 (K), Sutherland's law
/// k0 (T/T0)^(3/2) (T0 + S)/(T + S) with k0 = 0.0241 W/(m K), T0 = 273 K, S = 194 K: White, Viscous Fluid
/// Flow, 2nd ed., McGraw-Hill 1991, table 1-3, within 2 % from 160 to 2000 K. That of dilute air: it does not
/// rise with pressure here, and nothing dissociates.
inline double air_conductivity(double temperature) {
  constexpr double k0 = 0.0241, t0 = 273.0, s = 194.0;
  const double ratio = temperature / t0;
  return k0 * ratio * std::sqrt(ratio) * (t0 + s) / (temperature + s);
}

}  // namespace launchsafe::materials
