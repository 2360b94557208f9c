#include "launchsafe/materials/kinetics.hpp"

namespace launchsafe::materials {
namespace {

bool same_law(const KineticsParameters& a, const KineticsParameters& b) {
  return a.heat_of_reaction == b.heat_of_reaction && a.frequency == b.frequency &&
         a.activation_temperature == b.activation_temperature;
}

}  // namespace

double adiabatic_runaway_time(const KineticsParameters& k, double specific_heat, double from) {
  constexpr double to = 2000.0;  // K
  constexpr int intervals = 2000;
  const double theta = k.activation_temperature, begin = theta / from, end = theta / to;
  const double h = (begin - end) / intervals;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double x = i * h, temperature = theta / (begin - x);
    const double weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::exp(-x) * temperature * temperature / theta;
  }
  return h / 3.0 * sum / arrhenius_heating(k, specific_heat, from);
}

double reaction_degree(const KineticsParameters& k, double temperature) {
  if (std::isnan(temperature)) return temperature;
  if (temperature > k.burnt_temperature) return 1.0;
  if (temperature < k.ignition_temperature || !(k.ignition_temperature < k.burnt_temperature)) return 0.0;
  return (temperature - k.ignition_temperature) / (k.burnt_temperature - k.ignition_temperature);
}

KineticsParameters named_kinetics(const std::string& name) {
  KineticsParameters kinetics;
  if (name == "printed") kinetics.activation_temperature = 2.7e4;
  kinetics.name = name;
  return kinetics;
}

std::string name_of(const KineticsParameters& kinetics) {
  for (const std::string name : {"comp-b", "printed"}) {
    if (same_law(kinetics, named_kinetics(name))) return name;
  }
  return "custom";
}

}  // namespace launchsafe::materials
