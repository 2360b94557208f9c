// Air in the gap: an ideal gas on its adiabat (paper Eq. 21-27, Eq. 23 and 27 corrected).
#pragma once

namespace launchsafe::materials {

struct AirParameters {
  double density = 1.1766;             ///< rho_a0, kg/m3 at the initial state [L]; air_density of it
  double specific_heat = 1005.0;       ///< c_a, J/(kg K) [L]
  double heat_ratio = 1.4;             ///< gamma [P]
  double initial_temperature = 300.0;  ///< T0, K [P]
  double initial_pressure = 101325.0;  ///< p0, Pa [A]
};

/// Temperature (K) on the adiabat at pressure p >= p0 (Pa): T0 (p/p0)^((gamma-1)/gamma). Below p0 it stays at
/// T0, as the gap does not open below its initial state.
double adiabatic_temperature(const AirParameters& air, double pressure);

/// Density (kg/m3) of air at a temperature (K) and a pressure (Pa) by the gas law, from the
/// literature's 1.1766 at 300 K and 101 325 Pa.
double air_density(double temperature, double pressure);

/// The air of the same gap, filled at a temperature higher by `rise` (K): thinner by the gas law.
AirParameters warmed(AirParameters air, double rise);

}  // namespace launchsafe::materials
