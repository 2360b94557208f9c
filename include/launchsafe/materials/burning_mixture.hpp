// A particle of the charge that burns: what is left of the explosive and the gas that the rest has become, at
// one pressure.
//
// The skin that burns is thinner than a particle, so that a particle has both in parts of their own: the
// explosive on its isentrope (jwl.hpp), which burning in microseconds does not heat, and the gas
// with its own temperature (vlw.hpp). Sound crosses the particle within a step or two, so that the
// pressures are equal; heat does not cross it, so that the temperatures are not.
#pragma once

#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/vlw.hpp"

namespace launchsafe::materials {

/// State of a burning particle. Volumes are over that at rest, energies per volume at rest.
struct BurningState {
  /// Of the particle's mass: 0, or 1e-7 to 1. Less gas has no energy within the digits of that of the whole.
  double burnt_share = 0;
  double solid_volume = 1;     ///< V of the explosive that is left
  double gas_volume = 0;       ///< m3/kg
  double gas_temperature = 0;  ///< K
  double energy = 0;           ///< J/m3, of both: the explosive's from rest, the gas's from 0 K
  double work = 0;             ///< J/m3, that both have done by their pressure
  double pressure = 0;         ///< Pa
  double bulk_modulus = 0;     ///< Pa, of both at constant entropy
  bool valid = true;           ///< false: no such state in the range of the gas law

  /// Share of the explosive in the particle's volume V.
  double solid_share(double volume) const { return (1.0 - burnt_share) * solid_volume / volume; }
};

/// What a step does to a burning particle.
struct BurningStep {
  double volume_before = 1, volume_after = 1;  ///< V of the particle
  double burnt = 0;                            ///< share of the particle's mass that burns
  double fresh_energy = 0;                     ///< J/kg of the gas that it becomes, thermal, from 0 K
};

class BurningMixture {
 public:
  /// `solid_density`: kg/m3 of the explosive at rest. `tension_cutoff` (Pa): the explosive tears where its
  /// pressure falls below minus this.
  BurningMixture(const JwlParameters& solid, double solid_density, const ProductGas& gas,
                 double tension_cutoff);

  /// A particle at V of which nothing has burnt, at the pressure of the isentrope. Where it is torn, the
  /// explosive is at minus the cut-off and the rest of V is void, which the first gas fills.
  BurningState unburnt(double volume) const;
  /// The state after a step: energy changes by what burns and by the work of the mean of both pressures,
  /// d(energy) = rho0 burnt fresh_energy - (p0 + p1)/2 dV, and explosive and gas have one pressure. Where
  /// that mean misses the work of the explosive by more than little gas has energy, the step is done in
  /// parts, with the mean in each. Newton's method, and bisection where it does not arrive: the state is
  /// invalid only where the law has none.
  BurningState advance(const BurningState& before, const BurningStep& step) const;

  /// Pressure (Pa), bulk modulus (Pa) and mechanical energy (J/m3, from rest) of the explosive at V.
  double solid_pressure(double volume) const { return jwl_isentropic_pressure(solid_, volume); }
  double solid_modulus(double volume) const { return jwl_isentropic_bulk_modulus(solid_, volume); }
  double solid_energy(double volume) const { return jwl_isentropic_energy(solid_, volume); }
  /// The gas in a state of which something has burnt.
  GasState gas_of(const BurningState& state) const {
    return gas_.at(state.gas_temperature, state.gas_volume);
  }
  const ProductGas& gas() const { return gas_; }
  double solid_density() const { return solid_density_; }  ///< kg/m3, at rest

 private:
  int parts_of_step(const BurningState& before, const BurningStep& step) const;
  BurningState advance_part(const BurningState& before, const BurningStep& step) const;

  JwlParameters solid_;
  double solid_density_;
  ProductGas gas_;
  double torn_volume_ = 1;  ///< V of the explosive at the tension cut-off
};

}  // namespace launchsafe::materials
