#include "launchsafe/materials/ideal_gas.hpp"

#include <cmath>

namespace launchsafe::materials {
double adiabatic_temperature(const AirParameters& air, double pressure) {
  if (pressure <= air.initial_pressure) return air.initial_temperature;  // false for NaN, which goes through
  const double exponent = (air.heat_ratio - 1.0) / air.heat_ratio;
  return air.initial_temperature * std::pow(pressure / air.initial_pressure, exponent);
}

double air_density(double temperature, double pressure) {
  const AirParameters usual;
  return usual.density * (pressure / usual.initial_pressure) * (usual.initial_temperature / temperature);
}

AirParameters warmed(AirParameters air, double rise) {
  air.density *= air.initial_temperature / (air.initial_temperature + rise);
  air.initial_temperature += rise;
  return air;
}

}  // namespace launchsafe::materials
