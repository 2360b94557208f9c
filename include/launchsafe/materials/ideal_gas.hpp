// Air in the gap: an ideal gas on its adiabat (paper Eq. 21-27, Eq. 23 and 27 corrected).
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace launchsafe::materials {

struct AirParameters {
  double density = 1.1766;             ///< rho_a0, kg/m3 at the initial state [L]; air_density of it
  double specific_heat = 1005.0;       ///< c_a, J/(kg K) [L]
  double heat_ratio = 1.4;             ///< gamma [P]
  double initial_temperature = 300.0;  ///< T0, K [P]
  double initial_pressure = 101325.0;  ///< p0, Pa [A]
  double vibration_temperature = 0.0;  ///< K; 0: the heat capacity is constant
  double covolume = 0.0;               ///< m3/kg
};

/// R = c_a (gamma - 1)/gamma, J/(kg K).
double specific_gas_constant(const AirParameters& air);

/// The same air as it is hot and dense. Its molecules vibrate, as one harmonic oscillator of 3055.6 K (NACA
/// Report 1135, 1953: 5500 R), so that
///
///   c_p = c_a + R (x/2/sinh(x/2))^2,   x = 3055.6 K/T,
///
/// and have a volume of their own, p (v - b) = R T (Noble-Abel: Johnston, DSTO-TN-0670, 2005), which leaves
/// heat capacities and isentropes between temperature and pressure as they are. b = 1.03e-3 m3/kg is the
/// second virial coefficient of nitrogen at 1000 K (vlw.hpp). Nothing dissociates.
AirParameters hot_and_dense(AirParameters air);

/// Air on an isentrope.
struct CompressedAir {
  double temperature = 0;     ///< K
  double capacity_ratio = 1;  ///< c_p/c_a
  double slope = 1;           ///< of the temperature against the one that constant heat capacity gives
};

/// Isentropic changes. Along one of them T exp(S/c_a), with the entropy S of the vibrations, goes with
/// (p/p0)^(R/c_a), as T itself does where the heat capacity is constant; here is its inverse, tabulated to
/// 1e-10 up to some 7000 K and a straight line beyond.
class Isentropes {
 public:
  explicit Isentropes(const AirParameters& air = {});
  /// Air that would be as warm as this (K, > 0) without vibrations.
  CompressedAir at(double without) const;
  /// K, the inverse: what air of a temperature (K, > 0) would have without vibrations.
  double without(double temperature) const;

 private:
  std::vector<std::array<double, 2>> knots_;  ///< temperature and slope; none: constant heat capacity
};

/// J/kg, of the ideal gas at a temperature (K) above 0 K; a covolume adds b p.
double enthalpy(const AirParameters& air, double temperature);

/// Temperature (K) on the adiabat at any pressure p > 0 (Pa): T0 (p/p0)^((gamma-1)/gamma).
double isentropic_temperature(const AirParameters& air, double pressure);

/// Temperature (K) on the adiabat at pressure p >= p0 (Pa): T0 (p/p0)^((gamma-1)/gamma). Below p0 it stays at
/// T0, as the gap does not open below its initial state.
double adiabatic_temperature(const AirParameters& air, double pressure);

/// Density (kg/m3) of air at a temperature (K) and a pressure (Pa) by the gas law, from the
/// literature's 1.1766 at 300 K and 101 325 Pa.
double air_density(double temperature, double pressure);

/// The air of the same gap, filled at a temperature higher by `rise` (K): thinner by the gas law.
AirParameters warmed(AirParameters air, double rise);

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
