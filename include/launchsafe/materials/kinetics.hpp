// Zero-order Arrhenius decomposition and the ignition trigger of Composition B (paper Eq. 38-39, model
// section 4).
#pragma once

#include <cmath>
#include <string>

namespace launchsafe::materials {

struct KineticsParameters {
  std::string name = "comp-b";             ///< "comp-b" [C], "printed" [P] or "custom"
  double heat_of_reaction = 5.82e6;        ///< Q, J/kg [P]
  double frequency = 2.01e18;              ///< Z, 1/s [P]
  double activation_temperature = 2.17e4;  ///< E/R, K; 2.7e4 as printed
  double ignition_temperature = 526.784;   ///< T1, K [C]
  double burnt_temperature = 784.0;        ///< T2, K [P]: reaction degree 1, heating stops
};

/// Heating rate (K/s) of unreacted explosive at temperature T (K): (Q Z/c) exp(-(E/R)/T).
inline double arrhenius_heating(const KineticsParameters& k, double specific_heat, double temperature) {
  return k.heat_of_reaction * k.frequency / specific_heat * std::exp(-k.activation_temperature / temperature);
}

/// s, in which explosive at `from` (K) that loses no heat comes to 2000 K by its own, specific heat in J/(kg
/// K): the integral of dT/arrhenius_heating, by Simpson's rule in E/(R T), to nine digits. Infinite without
/// reaction. From 500 K on nearly all of it passes in the first tens of kelvin.
double adiabatic_runaway_time(const KineticsParameters& kinetics, double specific_heat, double from);

/// Reaction degree of Eq. 38: 0 below T1, linear to 1 at T2.
double reaction_degree(const KineticsParameters& k, double temperature);

/// The named kinetics: "comp-b", "printed", or "custom", which starts from "comp-b".
KineticsParameters named_kinetics(const std::string& name);
/// The name that belongs to the numbers.
std::string name_of(const KineticsParameters& kinetics);

}  // namespace launchsafe::materials
