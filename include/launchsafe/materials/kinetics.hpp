// Zero-order Arrhenius decomposition and the ignition trigger of Composition B (paper Eq. 38-39, model
// section 4).
#pragma once

#include <cmath>
#include <functional>
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

// Speed at which a flame that lives on conduction alone eats into a charge: the travelling wave of the heat
// equation (paper Eq. 38-39, model sections 4 and 5).

/// Speed u (m/s) of the steady wave of dT/dt = alpha d2T/dx2 + rate(T) that turns matter at `cold` (K) into
/// matter at `hot` (K) > `cold`; alpha in m2/s > 0. `rate` (K/s) vanishes at both ends and must be positive
/// below `hot`. In the plane of T and g = dT/dx the wave is alpha g dg/dT = u g - rate with g = 0 at both
/// ends; u is found by bisection (Zeldovich & Frank-Kamenetskii 1938). Where waves of several speeds exist it
/// is the slowest, which is the one that forms. A rate that grows linearly from `cold` on (Kolmogorov,
/// Petrovsky & Piskunov 1937) is outside of this method; an Arrhenius rate grows far faster. 0 where `rate`
/// is not positive.
double travelling_wave_speed(const std::function<double(double)>& rate, double diffusivity, double cold,
                             double hot);

/// That speed for the published reaction rate (Q Z/c)(1 - lambda) exp(-(E/R)/T) between `unburnt` (K) and the
/// temperature T2 at which lambda = 1. The rate at `unburnt` itself, which acts everywhere ahead of the wave
/// and is no part of it, is taken off. No mesh of a launch resolves the wave: it is some alpha/u thick, which
/// is below a micrometre. 0 where the heat of reaction does not bring `unburnt` to T2. `conductivity` in W/(m
/// K), `density` in kg/m3, `specific_heat` in J/(kg K).
double deflagration_speed(const KineticsParameters& kinetics, double conductivity, double density,
                          double specific_heat, double unburnt);

}  // namespace launchsafe::materials
