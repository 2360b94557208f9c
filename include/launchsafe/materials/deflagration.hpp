// Speed at which a flame that lives on conduction alone eats into a charge: the travelling wave of the heat
// equation (paper Eq. 38-39, model sections 4 and 5).
#pragma once

#include "launchsafe/materials/kinetics.hpp"

#include <functional>

namespace launchsafe::materials {

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
