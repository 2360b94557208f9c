#include "launchsafe/materials/jwl.hpp"

namespace launchsafe::materials {

JwlParameters unreacted_composition_b() {
  JwlParameters parameters;  // the defaults are the unreacted explosive
  parameters.initial_energy = -jwl_cold_pressure(parameters, 1.0) / parameters.omega;
  return parameters;
}

JwlParameters composition_b_products() {
  JwlParameters parameters;
  parameters.a = 5.242e11;
  parameters.b = 7.678e9;
  parameters.r1 = 4.2;
  parameters.r2 = 1.1;
  parameters.omega = 0.34;
  parameters.initial_energy = 8.5e9;
  return parameters;
}

double jwl_energy_at_temperature(const JwlParameters& m, double v, double heat_capacity, double temperature) {
  return m.a / m.r1 * std::exp(-m.r1 * v) + m.b / m.r2 * std::exp(-m.r2 * v) + heat_capacity * temperature;
}

double chapman_jouguet_volume(const JwlParameters& m, double velocity, double pressure) {
  return 1.0 - pressure / (m.initial_density * velocity * velocity);
}

double chapman_jouguet_initial_energy(const JwlParameters& m, double velocity, double pressure) {
  const double volume = chapman_jouguet_volume(m, velocity, pressure);
  const double energy = (pressure - jwl_cold_pressure(m, volume)) * volume / m.omega;
  return energy - 0.5 * pressure * (1.0 - volume);
}

}  // namespace launchsafe::materials
