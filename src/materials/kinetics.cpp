#include "launchsafe/materials/kinetics.hpp"

namespace launchsafe::materials {
double reaction_degree(const KineticsParameters& k, double temperature) {
  if (std::isnan(temperature)) return temperature;
  if (temperature > k.burnt_temperature) return 1.0;
  if (temperature < k.ignition_temperature || !(k.ignition_temperature < k.burnt_temperature)) return 0.0;
  return (temperature - k.ignition_temperature) / (k.burnt_temperature - k.ignition_temperature);
}

}  // namespace launchsafe::materials
