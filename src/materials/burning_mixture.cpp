#include "launchsafe/materials/burning_mixture.hpp"

namespace launchsafe::materials {
namespace {

/// V of the explosive below any that pressures of a gas within its law reach.
constexpr double smallest_solid = 0.2;

/// Explosive and gas at the end of a step: V of the explosive, specific volume (m3/kg) and temperature (K) of
/// the gas.
struct Parts {
  double solid_volume, gas_volume, gas_temperature;
};

/// What of a step does not depend on its unknowns. These are the temperature of the gas and the volume of
/// what there is less of, which follows from the other one without loss of digits.
struct Balance {
  double burnt_share;      ///< at the end
  double volume;           ///< V of the particle at the end
  double initial_density;  ///< kg/m3
  double fixed_energy;     ///< J/m3: before, with what burns, less the work of the pressure before
  double half_growth;      ///< half the change of V

  double burnt_density() const { return burnt_share * initial_density; }
  bool by_gas() const { return burnt_share < 0.5; }
  double gas_volume(double solid_volume) const {
    return (volume - (1.0 - burnt_share) * solid_volume) / burnt_density();
  }
  /// The parts moved by a change of the unknown volume and of the temperature.
  Parts moved(const Parts& from, double volume_change, double temperature_change) const {
    const double temperature = from.gas_temperature + temperature_change;
    if (by_gas()) {
      const double gas = from.gas_volume + volume_change;
      return {(volume - burnt_density() * gas) / (1.0 - burnt_share), gas, temperature};
    }
    const double solid = from.solid_volume + volume_change;
    return {solid, gas_volume(solid), temperature};
  }
};

/// Two equations: gas pressure less explosive pressure (Pa), and energy less what it has to be (J/m3).
struct Residual {
  double pressure, energy;
  double pressure_by_volume, pressure_by_temperature, energy_by_volume, energy_by_temperature;
  bool valid;

  double determinant() const {
    return pressure_by_volume * energy_by_temperature - pressure_by_temperature * energy_by_volume;
  }
  /// Newton's changes of volume and of temperature.
  double volume_change() const {
    return (pressure_by_temperature * energy - energy_by_temperature * pressure) / determinant();
  }
  double temperature_change() const {
    return (energy_by_volume * pressure - pressure_by_volume * energy) / determinant();
  }
};

Residual residual_of(const BurningMixture& mixture, const Balance& balance, const Parts& at) {
  const double unburnt = 1.0 - balance.burnt_share, burnt = balance.burnt_density();
  const double solid_by_unknown = balance.by_gas() ? -burnt / unburnt : 1.0;
  const double gas_by_unknown = balance.by_gas() ? 1.0 : -unburnt / burnt;
  const GasState gas = mixture.gas().at(at.gas_temperature, at.gas_volume);
  const double solid_pressure = mixture.solid_pressure(at.solid_volume);
  const double solid_slope = -mixture.solid_modulus(at.solid_volume) / at.solid_volume * solid_by_unknown;
  Residual r{};
  r.valid = gas.valid && std::isfinite(solid_pressure) && at.solid_volume > 0.0;
  r.pressure = gas.pressure - solid_pressure;
  r.pressure_by_volume = gas.pressure_by_volume * gas_by_unknown - solid_slope;
  r.pressure_by_temperature = gas.pressure_by_temperature;
  r.energy = unburnt * mixture.solid_energy(at.solid_volume) + burnt * gas.energy -
             (balance.fixed_energy - solid_pressure * balance.half_growth);
  r.energy_by_volume = -unburnt * solid_pressure * solid_by_unknown +
                       burnt * gas.energy_by_volume * gas_by_unknown + solid_slope * balance.half_growth;
  r.energy_by_temperature = burnt * gas.energy_by_temperature;
  return r;
}

/// The energy of the explosive is a difference of terms that are far larger than what little gas has; their
/// round-off is what its temperature can be known to, as a share of it.
double resolution(const Balance& balance) { return 1e-11 + 1e-14 / balance.burnt_share; }

/// Whether Newton's changes are at most such a share of the unknowns.
bool is_within(const Balance& balance, const Parts& parts, const Residual& residual, double share) {
  const double unknown = balance.by_gas() ? parts.gas_volume : parts.solid_volume;
  return std::abs(residual.volume_change()) <= share * unknown &&
         std::abs(residual.temperature_change()) <= share * parts.gas_temperature;
}

/// Newton's method; steps that leave the range of the laws are halved. False where it does not arrive.
bool solve_by_newton(const BurningMixture& mixture, const Balance& balance, Parts& parts) {
  constexpr int most_iterations = 100, most_halvings = 40;
  const double enough = resolution(balance);
  Residual here = residual_of(mixture, balance, parts);
  for (int i = 0; here.valid && i < most_iterations; ++i) {
    double volume_change = here.volume_change(), temperature_change = here.temperature_change();
    const bool arrives = is_within(balance, parts, here, enough);
    const Parts before = parts;
    for (int halving = 0; halving < most_halvings; ++halving) {
      parts = balance.moved(before, volume_change, temperature_change);
      here = residual_of(mixture, balance, parts);
      if (here.valid) break;
      volume_change *= 0.5;
      temperature_change *= 0.5;
    }
    if (arrives) return here.valid;
  }
  return false;
}

/// An interval that is halved until its ends are neighbouring numbers, or as good as.
struct Interval {
  static constexpr int halvings = 120;
  double low, high;
  double middle() const { return 0.5 * (low + high); }
  bool is_closed() const { return !(low < middle() && middle() < high); }
};

/// Explosive and gas at one pressure, with the gas at a temperature (K): the pressures' difference goes one
/// way with the volume that either has. Gas outside of its law is taken as too dense, for where it is thin
/// the law holds. Nothing where no volume gives equal pressures. `torn`: largest V of the explosive.
std::optional<Parts> at_equal_pressure(const BurningMixture& mixture, const Balance& balance, double torn,
                                       double temperature) {
  constexpr double densest_gas = 0.05;  // its volume over that of the explosive at rest, likewise
  const double unburnt = 1.0 - balance.burnt_share, burnt = balance.burnt_density();
  const auto parts_of = [&](double unknown) {
    if (!balance.by_gas()) return Parts{unknown, balance.gas_volume(unknown), temperature};
    const double gas = std::exp(unknown);
    return Parts{(balance.volume - burnt * gas) / unburnt, gas, temperature};
  };
  Interval interval = balance.by_gas()
                          ? Interval{std::log(std::max(densest_gas / balance.initial_density,
                                                       (balance.volume - unburnt * torn) / burnt)),
                                     std::log((balance.volume - unburnt * smallest_solid) / burnt)}
                          : Interval{smallest_solid, std::min(torn, balance.volume / unburnt)};
  for (int i = 0; i < Interval::halvings && !interval.is_closed(); ++i) {
    const Residual residual = residual_of(mixture, balance, parts_of(interval.middle()));
    const bool gas_must_grow = !residual.valid || residual.pressure > 0.0;
    (gas_must_grow == balance.by_gas() ? interval.low : interval.high) = interval.middle();
  }
  constexpr double enough = 1e-6;  // of the unknown: what is further away has no such volume near it
  const Parts parts = parts_of(interval.middle());
  const Residual residual = residual_of(mixture, balance, parts);
  const double volume = balance.by_gas() ? parts.gas_volume : parts.solid_volume;
  if (!residual.valid ||
      !(std::abs(residual.pressure) <= enough * volume * std::abs(residual.pressure_by_volume)))
    return std::nullopt;
  return parts;
}

/// The slow way, which arrives wherever there is a state: the energy at equal pressures rises with the
/// temperature. Nothing where the law has no such state.
std::optional<Parts> solve_by_bisection(const BurningMixture& mixture, const Balance& balance, double torn) {
  Interval temperature{ProductGas::lowest_temperature, ProductGas::highest_temperature};
  std::optional<Parts> found;
  for (int i = 0; i < Interval::halvings && !temperature.is_closed(); ++i) {
    const double middle = temperature.middle();
    const auto parts = at_equal_pressure(mixture, balance, torn, middle);
    // Gas that is too cold for its density condenses, and has no volume.
    const bool too_cold = !parts || residual_of(mixture, balance, *parts).energy < 0.0;
    (too_cold ? temperature.low : temperature.high) = middle;
    if (parts) found = parts;
  }
  if (!found) return std::nullopt;
  Parts parts = *found;
  if (solve_by_newton(mixture, balance, parts)) return parts;
  // Volumes and temperature by intervals of their own are less sharp than by Newton's method.
  constexpr double blunter = 1e3;
  const Residual residual = residual_of(mixture, balance, *found);
  if (residual.valid && is_within(balance, *found, residual, blunter * resolution(balance))) return found;
  return std::nullopt;
}

}  // namespace

BurningMixture::BurningMixture(const JwlParameters& solid, double solid_density, const ProductGas& gas,
                               double tension_cutoff)
    : solid_(solid), solid_density_(solid_density), gas_(gas) {
  constexpr int most_iterations = 50;
  for (int i = 0; i < most_iterations; ++i)
    torn_volume_ +=
        (solid_pressure(torn_volume_) + tension_cutoff) * torn_volume_ / solid_modulus(torn_volume_);
}

BurningState BurningMixture::unburnt(double volume) const {
  BurningState state;
  state.solid_volume = std::min(volume, torn_volume_);
  state.energy = solid_energy(state.solid_volume);
  state.pressure = solid_pressure(state.solid_volume);
  state.bulk_modulus = solid_modulus(state.solid_volume);
  return state;
}

int BurningMixture::parts_of_step(const BurningState& before, const BurningStep& step) const {
  constexpr double enough = 1e-3, most = 1000.0;  // of the gas's energy; parts
  const double growth = step.volume_after - step.volume_before;
  const double unburnt = std::max(0.0, 1.0 - before.burnt_share - step.burnt);
  const double begin = before.solid_volume,
               end = std::min(std::max(begin + growth, smallest_solid), torn_volume_);
  const double missed = solid_energy(end) - solid_energy(begin) +
                        0.5 * (solid_pressure(begin) + solid_pressure(end)) * (end - begin);
  const double gas = solid_density_ * (before.burnt_share * gas_.specific_heat() * before.gas_temperature +
                                       step.burnt * step.fresh_energy);
  const double parts = std::ceil(std::sqrt(unburnt * std::abs(missed) / (enough * gas)));
  return parts > 1.0 ? static_cast<int>(std::min(parts, most)) : 1;
}

BurningState BurningMixture::advance(const BurningState& before, const BurningStep& step) const {
  if (!before.valid) return before;
  if (!(before.burnt_share + step.burnt > 0.0)) {
    BurningState after = unburnt(step.volume_after);
    after.work = before.work + before.energy - after.energy;
    return after;
  }
  // The first gas ends the tension of torn explosive at once, before that could work on it.
  if (before.burnt_share == 0.0 && before.pressure < 0.0 && step.volume_after != step.volume_before)
    return advance(
        advance_part(before, {step.volume_before, step.volume_before, step.burnt, step.fresh_energy}),
        {step.volume_before, step.volume_after, 0.0, 0.0});
  const int parts = parts_of_step(before, step);
  const double growth = (step.volume_after - step.volume_before) / parts;
  BurningState state = before;
  for (int part = 1; part <= parts && state.valid; ++part) {
    const double begin = step.volume_before + (part - 1) * growth;
    const double end = part == parts ? step.volume_after : step.volume_before + part * growth;
    // All of it burns in the first part, so that no part has less gas than it may have.
    state = advance_part(state, {begin, end, part == 1 ? step.burnt : 0.0, step.fresh_energy});
  }
  return state;
}

BurningState BurningMixture::advance_part(const BurningState& before, const BurningStep& step) const {
  BurningState after = before;
  after.burnt_share = std::min(1.0, before.burnt_share + step.burnt);
  const double burnt = after.burnt_share - before.burnt_share;
  const double half_growth = 0.5 * (step.volume_after - step.volume_before);
  const Balance balance{
      after.burnt_share, step.volume_after, solid_density_,
      before.energy + solid_density_ * burnt * step.fresh_energy - before.pressure * half_growth,
      half_growth};
  // What burns starts from the density of the explosive: from the dense side pressure falls to that of the
  // explosive without overshooting.
  const double old_part = before.burnt_share / after.burnt_share, new_part = 1.0 - old_part;
  Parts parts{before.solid_volume,
              old_part * before.gas_volume + new_part * before.solid_volume / solid_density_,
              old_part * before.gas_temperature + new_part * step.fresh_energy / gas_.specific_heat()};
  // The first gas in torn explosive has the void to itself.
  if (!(before.burnt_share > 0.0))
    parts.gas_volume =
        std::max(parts.gas_volume, balance.gas_volume(std::min(before.solid_volume, torn_volume_)));
  parts = balance.by_gas()
              ? balance.moved(parts, 0.0, 0.0)
              : Parts{parts.solid_volume, balance.gas_volume(parts.solid_volume), parts.gas_temperature};
  if (!solve_by_newton(*this, balance, parts)) {
    const auto found = solve_by_bisection(*this, balance, torn_volume_);
    after.valid = found.has_value();
    if (found) parts = *found;
  }
  if (!after.valid) return after;
  after.solid_volume = parts.solid_volume;
  after.gas_volume = parts.gas_volume;
  after.gas_temperature = parts.gas_temperature;
  after.pressure = solid_pressure(parts.solid_volume);
  after.energy = balance.fixed_energy - after.pressure * half_growth;
  after.work += (before.pressure + after.pressure) * half_growth;
  const double share = after.solid_share(step.volume_after);
  const double gas_modulus = gas_.at(parts.gas_temperature, parts.gas_volume)
                                 .isentropic_modulus(parts.gas_temperature, parts.gas_volume);
  after.bulk_modulus = 1.0 / (share / solid_modulus(parts.solid_volume) + (1.0 - share) / gas_modulus);
  return after;
}

}  // namespace launchsafe::materials
