// Zero-order Arrhenius decomposition and the ignition trigger of Composition B (paper Eq. 38-39, model
// section 4).
#pragma once

#include <cmath>

namespace launchsafe::materials {

struct KineticsParameters {
  double heat_of_reaction = 5.82e6;        ///< Q, J/kg [P]
  double frequency = 2.01e18;              ///< Z, 1/s [P]
  double activation_temperature = 2.17e4;  ///< E/R, K; 2.7e4 as printed
  double ignition_temperature = 524.5223;  ///< T1, K [C]
  double burnt_temperature = 784.0;        ///< T2, K [P]: reaction degree 1, heating stops
};

/// Heating rate (K/s) of unreacted explosive at temperature T (K): (Q Z/c) exp(-(E/R)/T).
inline double arrhenius_heating(const KineticsParameters& k, double specific_heat, double temperature) {
  return k.heat_of_reaction * k.frequency / specific_heat * std::exp(-k.activation_temperature / temperature);
}

/// Reaction degree of Eq. 38: 0 below T1, linear to 1 at T2.
double reaction_degree(const KineticsParameters& k, double temperature);

}  // namespace launchsafe::materials
