#include "launchsafe/materials/ideal_gas.hpp"

#include <cmath>

namespace launchsafe::materials {

double adiabatic_temperature(const AirParameters& air, double pressure) {
  if (pressure <= air.initial_pressure) return air.initial_temperature;  // false for NaN, which goes through
  const double exponent = (air.heat_ratio - 1.0) / air.heat_ratio;
  return air.initial_temperature * std::pow(pressure / air.initial_pressure, exponent);
}

}  // namespace launchsafe::materials
