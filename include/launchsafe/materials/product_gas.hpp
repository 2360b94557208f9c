// The gas that a burnt charge turns into: VLW pressure (vlw.hpp) with the internal energy that belongs to it,
// tabulated over temperature so that a step of a burning particle costs no series.
#pragma once

#include "launchsafe/materials/vlw.hpp"

#include <array>
#include <vector>

namespace launchsafe::materials {

/// Pressure and energy of the gas at one temperature and specific volume, with what solvers need of them.
struct GasState {
  double pressure = 0;                 ///< Pa
  double energy = 0;                   ///< J/kg
  double pressure_by_temperature = 0;  ///< Pa/K, at constant volume
  double pressure_by_volume = 0;       ///< Pa kg/m3, at constant temperature
  double energy_by_temperature = 0;    ///< J/(kg K), the heat capacity at constant volume
  double energy_by_volume = 0;         ///< Pa: T dp/dT - p
  double compressibility = 0;          ///< Z
  /// False outside the range of the law: Z <= 0, a pressure that falls on compression, a heat capacity that
  /// is not positive, or a temperature outside of the table. Nothing of such a state may be used.
  bool valid = false;
  /// Bulk modulus at constant entropy, Pa, at the state's specific volume (m3/kg).
  double isentropic_modulus(double temperature, double volume) const;
};

/// A gas mixture with three terms of the virial series, p = (n R T/v) Z, Z = 1 + beta1 n/v + beta2 (n/v)^2
/// with n in mol/kg, v in m3/kg and beta1, beta2 linear in the mole fractions as in `virial_state` [A]. Its
/// energy is e = c_v T - n R T^2 (beta1' n/v + beta2' (n/v)^2/2), which makes pressure and energy one law:
/// de/dv = T dp/dT - p at constant temperature. The heat capacity c_v of the thin gas is a constant [A].
class ProductGas {
 public:
  /// `specific_heat` in J/(kg K), > 0.
  ProductGas(const std::vector<GasComponent>& components, double specific_heat);

  /// At T (K) > 0 and v (m3/kg) > 0.
  GasState at(double temperature, double volume) const;
  /// Temperature (K) at which the gas has an energy (J/kg) at a volume (m3/kg), by Newton's method from
  /// `guess` (K); NaN where there is none in the range of the law.
  double temperature_at(double energy, double volume, double guess) const;
  double specific_heat() const { return specific_heat_; }

  /// Temperatures (K) between which the virial coefficients are tabulated.
  static constexpr double lowest_temperature = 200.0, highest_temperature = 9000.0;

 private:
  using Coefficients = std::array<double, 32>;
  double amount_ = 0;  ///< mol/kg
  double specific_heat_ = 0;
  Coefficients second_{}, third_{};  ///< beta1 and beta2 over the logarithm of temperature
};

}  // namespace launchsafe::materials
