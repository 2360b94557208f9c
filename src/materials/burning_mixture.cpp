#include "launchsafe/materials/burning_mixture.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::materials {
namespace {

/// The two unknowns of a step.
struct Unknowns {
  double solid_volume;     ///< V of the explosive
  double gas_temperature;  ///< K
};

/// Two equations in them: gas pressure less explosive pressure (Pa), and energy less what it has to be
/// (J/m3).
struct Residual {
  double pressure, energy;
  double pressure_by_volume, pressure_by_temperature, energy_by_volume, energy_by_temperature;
  bool valid;

  Unknowns newton_change() const {
    const double determinant =
        pressure_by_volume * energy_by_temperature - pressure_by_temperature * energy_by_volume;
    return {(pressure_by_temperature * energy - energy_by_temperature * pressure) / determinant,
            (energy_by_volume * pressure - pressure_by_volume * energy) / determinant};
  }
};

/// What of a step does not depend on the unknowns.
struct Balance {
  double burnt_share;      ///< at the end
  double volume;           ///< V of the particle at the end
  double initial_density;  ///< kg/m3
  double fixed_energy;     ///< J/m3: before, with what burns, less the work of the pressure before
  double half_growth;      ///< half the change of V

  double gas_volume(double solid_volume) const {
    return (volume - (1.0 - burnt_share) * solid_volume) / (burnt_share * initial_density);
  }
};

Residual residual_of(const BurningMixture& mixture, const Balance& balance, const Unknowns& at) {
  const double unburnt = 1.0 - balance.burnt_share;
  const double burnt_density = balance.burnt_share * balance.initial_density;
  const GasState gas = mixture.gas().at(at.gas_temperature, balance.gas_volume(at.solid_volume));
  const double solid_pressure = mixture.solid_pressure(at.solid_volume);
  const double solid_slope = -mixture.solid_modulus(at.solid_volume) / at.solid_volume;
  Residual r{};
  r.valid = gas.valid && std::isfinite(solid_pressure);
  r.pressure = gas.pressure - solid_pressure;
  r.pressure_by_volume = -unburnt / burnt_density * gas.pressure_by_volume - solid_slope;
  r.pressure_by_temperature = gas.pressure_by_temperature;
  r.energy = unburnt * mixture.solid_energy(at.solid_volume) + burnt_density * gas.energy -
             (balance.fixed_energy - solid_pressure * balance.half_growth);
  r.energy_by_volume = -unburnt * (solid_pressure + gas.energy_by_volume) + solid_slope * balance.half_growth;
  r.energy_by_temperature = burnt_density * gas.energy_by_temperature;
  return r;
}

/// Newton's method; steps that leave the range of the laws are halved. False where it does not arrive.
bool solve(const BurningMixture& mixture, const Balance& balance, Unknowns& unknowns) {
  constexpr int most_iterations = 100, most_halvings = 40;
  constexpr double enough = 1e-14;
  Residual here = residual_of(mixture, balance, unknowns);
  for (int i = 0; here.valid && i < most_iterations; ++i) {
    Unknowns change = here.newton_change();
    if (std::abs(change.solid_volume) <= enough * unknowns.solid_volume &&
        std::abs(change.gas_temperature) <= 100.0 * enough * unknowns.gas_temperature)
      return true;
    Unknowns next{};
    for (int halving = 0; halving < most_halvings; ++halving) {
      next = {unknowns.solid_volume + change.solid_volume, unknowns.gas_temperature + change.gas_temperature};
      here = residual_of(mixture, balance, next);
      if (here.valid) break;
      change = {0.5 * change.solid_volume, 0.5 * change.gas_temperature};
    }
    // Round-off of the residual ends the descent before the change does.
    const bool stands = std::abs(change.solid_volume) <= 1e-12 * unknowns.solid_volume &&
                        std::abs(change.gas_temperature) <= 1e-10 * unknowns.gas_temperature;
    unknowns = next;
    if (stands && here.valid) return true;
  }
  return false;
}

}  // namespace

BurningMixture::BurningMixture(const JwlParameters& solid, const ProductGas& gas)
    : solid_(solid), gas_(gas) {}

double BurningMixture::solid_energy(double volume) const {
  const double thermal = solid_.initial_energy - jwl_cold_energy(solid_, 1.0);
  return jwl_cold_energy(solid_, volume) + thermal * std::pow(volume, -solid_.omega) - solid_.initial_energy;
}

GasState BurningMixture::gas_of(const BurningState& state, double volume) const {
  return gas_.at(state.gas_temperature, (volume - (1.0 - state.burnt_share) * state.solid_volume) /
                                            (state.burnt_share * solid_.initial_density));
}

BurningState BurningMixture::unburnt(double volume) const {
  BurningState state;
  state.solid_volume = volume;
  state.energy = solid_energy(volume);
  state.pressure = solid_pressure(volume);
  state.bulk_modulus = solid_modulus(volume);
  return state;
}

BurningState BurningMixture::advance(const BurningState& before, const BurningStep& step) const {
  BurningState after = before;
  after.burnt_share = std::min(1.0, before.burnt_share + step.burnt);
  const double burnt = after.burnt_share - before.burnt_share;
  const double half_growth = 0.5 * (step.volume_after - step.volume_before);
  if (!(after.burnt_share > 0.0)) {
    after = unburnt(step.volume_after);
    after.energy = before.energy - (before.pressure + after.pressure) * half_growth;
    return after;
  }
  const Balance balance{
      after.burnt_share, step.volume_after, solid_.initial_density,
      before.energy + solid_.initial_density * burnt * step.fresh_energy - before.pressure * half_growth,
      half_growth};
  // The first gas starts from the density of the explosive: from the dense side pressure falls to that of the
  // explosive without overshooting.
  Unknowns unknowns{
      before.burnt_share > 0.0 ? before.solid_volume : step.volume_after,
      before.burnt_share > 0.0 ? before.gas_temperature : step.fresh_energy / gas_.specific_heat()};
  after.valid = before.valid && solve(*this, balance, unknowns);
  if (!after.valid) return after;
  after.solid_volume = unknowns.solid_volume;
  after.gas_temperature = unknowns.gas_temperature;
  after.pressure = solid_pressure(unknowns.solid_volume);
  after.energy = balance.fixed_energy - after.pressure * half_growth;
  const double share = after.solid_share(step.volume_after);
  const double gas_volume = balance.gas_volume(unknowns.solid_volume);
  const double gas_modulus =
      gas_.at(unknowns.gas_temperature, gas_volume).isentropic_modulus(unknowns.gas_temperature, gas_volume);
  after.bulk_modulus = 1.0 / (share / solid_modulus(unknowns.solid_volume) + (1.0 - share) / gas_modulus);
  return after;
}

}  // namespace launchsafe::materials
