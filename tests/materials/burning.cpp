// What a burnt charge becomes: the energy of the gas, and the mixture in a particle.
#include "launchsafe/materials/burning_mixture.hpp"
#include "launchsafe/materials/charge.hpp"
#include "launchsafe/materials/kinetics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK
#include <rapidcheck.h>
#endif

namespace {

using namespace launchsafe::materials;

constexpr double specific_heat = 1780.0, tension_cutoff = 5e6;
const ProductGas& products() {
  static const ProductGas gas(composition_b_gas(), specific_heat);
  return gas;
}
/// Molecules without size and attraction: the ideal gas.
ProductGas ideal_gas() { return ProductGas({{{100.0, 0.0}, 30.0}}, 1200.0); }
BurningMixture mixture() {
  return BurningMixture(unreacted_composition_b(), 1717.0, products(), tension_cutoff);
}

/// Z of one gas at T (K) and molar volume V (m3/mol), Eq. 37 corrected: 1 + B* x + B*/T*^(1/4) x^2, x = b0/V.
double virial_compressibility(const LennardJones& gas, double temperature, double molar_volume) {
  const double reduced = temperature / gas.temperature, x = gas.covolume / molar_volume;
  const double second = reduced_second_virial(reduced);
  return 1.0 + second * x + second / std::pow(reduced, 0.25) * x * x;
}

constexpr double amount = 30.447;  // mol per kg of the products
/// Z of the products at a density (kg/m3): the mean over their moles.
double compressibility_at(double temperature, double density) {
  double mean = 0.0;
  for (const GasComponent& gas : composition_b_gas())
    mean +=
        gas.amount / amount * virial_compressibility(gas.potential, temperature, 1.0 / (density * amount));
  return mean;
}

TEST(ProductGas, PressureIsThatOfTheVirialSeries) {
  for (const double temperature : {250.0, 784.0, 2000.0, 6000.0})
    for (const double density : {1.0, 100.0, 600.0, 1700.0}) {
      const double series = compressibility_at(temperature, density);
      const GasState gas = products().at(temperature, 1.0 / density);
      EXPECT_NEAR(gas.compressibility, series, 1e-11 * (1.0 + std::abs(series)))
          << temperature << " " << density;
      const bool rises =
          density * (1.0 + 1e-6) * compressibility_at(temperature, density * (1.0 + 1e-6)) > density * series;
      if (series > 0.0 && rises) {
        EXPECT_NEAR(gas.pressure / (series * gas_constant * temperature * density * amount), 1.0, 1e-10);
      } else {
        EXPECT_FALSE(gas.valid);
      }
    }
}

TEST(ProductGas, DerivativesAreThoseOfPressureAndEnergy) {
  for (const double temperature : {784.0, 1500.0, 3000.0})
    for (const double volume : {1.0 / 1700.0, 1.0 / 500.0, 1.0 / 20.0}) {
      const GasState gas = products().at(temperature, volume);
      const double d = 1e-4 * temperature, dv = 1e-5 * volume;
      const GasState hot = products().at(temperature + d, volume),
                     cold = products().at(temperature - d, volume);
      const GasState wide = products().at(temperature, volume + dv),
                     tight = products().at(temperature, volume - dv);
      EXPECT_NEAR((hot.pressure - cold.pressure) / (2 * d) / gas.pressure_by_temperature, 1.0, 1e-6);
      EXPECT_NEAR((hot.energy - cold.energy) / (2 * d) / gas.energy_by_temperature, 1.0, 1e-6);
      EXPECT_NEAR((wide.pressure - tight.pressure) / (2 * dv) / gas.pressure_by_volume, 1.0, 1e-6);
      // Maxwell's relation: de/dv = T dp/dT - p.
      EXPECT_NEAR((wide.energy - tight.energy) / (2 * dv), gas.energy_by_volume, 1e-5 * gas.pressure);
    }
}

TEST(ProductGas, AnIdealGasFollowsItsAdiabat) {
  const ProductGas gas = ideal_gas();
  const double gas_r = 30.0 * gas_constant, gamma = 1.0 + gas_r / gas.specific_heat();
  const GasState state = gas.at(700.0, 0.01);
  EXPECT_NEAR(state.pressure, gas_r * 700.0 / 0.01, 1e-6);
  EXPECT_NEAR(state.energy, 1200.0 * 700.0, 1e-6);
  EXPECT_NEAR(state.isentropic_modulus(700.0, 0.01), gamma * state.pressure, 1e-3);
}

TEST(ProductGas, StatesOutsideOfTheLawAreMarked) {
  EXPECT_FALSE(products().at(100.0, 0.01).valid);
  EXPECT_FALSE(products().at(20000.0, 0.01).valid);
  EXPECT_FALSE(products().at(784.0, -1.0).valid);
  // Steam alone at the density of the explosive: Z = -0.44 (model section 4).
  const ProductGas steam({{water(), 55.5}}, specific_heat);
  EXPECT_LT(steam.at(784.0, 1.0 / 1717.0).compressibility, 0.0);
  EXPECT_FALSE(steam.at(784.0, 1.0 / 1717.0).valid);
  EXPECT_FALSE(steam.at(500.0, -1.0).valid);
}

TEST(BurningMixture, IsTheUnreactedLawWhereNothingHasBurnt) {
  const BurningMixture law = mixture();
  BurningState state = law.unburnt(1.0);
  for (const double volume : {0.999, 0.98, 0.95, 0.99}) {
    const double before = state.solid_volume;
    state = law.advance(state, {before, volume, 0.0, 0.0});
    EXPECT_EQ(state.pressure, jwl_isentropic_pressure(unreacted_composition_b(), volume));
  }
}

TEST(BurningMixture, BurntAtConstantVolumeEndsInTheClosedFormState) {
  // No work is done, so that the energy of the gas is that of what burnt and the elastic energy before.
  const BurningMixture law = mixture();
  const double volume = 0.98, fresh = specific_heat * 784.0;
  const double density = 1717.0 / volume;
  const double energy = fresh + law.solid_energy(volume) / 1717.0;
  // The energy rises with the temperature.
  double temperature = 500.0, above = 5000.0;
  while (above - temperature > 1e-10 * above) {
    const double middle = 0.5 * (temperature + above);
    (products().at(middle, 1.0 / density).energy < energy ? temperature : above) = middle;
  }
  const double pressure = products().at(temperature, 1.0 / density).pressure;
  for (const int steps : {1, 10, 1000}) {
    BurningState state = law.unburnt(volume);
    for (int i = 0; i < steps; ++i) state = law.advance(state, {volume, volume, 1.0 / steps, fresh});
    ASSERT_TRUE(state.valid) << steps;
    EXPECT_NEAR(state.burnt_share, 1.0, 1e-12);
    EXPECT_NEAR(state.gas_temperature / temperature, 1.0, 1e-9) << steps;
    EXPECT_NEAR(state.pressure / pressure, 1.0, 1e-8) << steps;
  }
}

TEST(BurningMixture, PressureIsContinuousAndEnergyConservedInBetween) {
  // While it burns under a volume that goes up and down: energy less released heat plus work stays, and no
  // step jumps.
  const BurningMixture law = mixture();
  BurningState state = law.unburnt(0.985);
  const double start = state.energy, fresh = specific_heat * 784.0;
  double volume = 0.985, work = 0;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double next = 0.985 + 0.8 * (i + 1) / steps + 0.01 * std::sin(40.0 * (i + 1) / steps);
    const BurningState after = law.advance(state, {volume, next, 1.0 / steps, fresh});
    ASSERT_TRUE(after.valid) << i;
    EXPECT_LT(std::abs(after.pressure - state.pressure), 0.05 * state.pressure) << i;
    work += 0.5 * (state.pressure + after.pressure) * (next - volume);
    volume = next;
    state = after;
    const GasState gas = law.gas_of(state);
    EXPECT_NEAR(gas.pressure / state.pressure, 1.0, 1e-6) << i;
    const double stored = (1 - state.burnt_share) * law.solid_energy(state.solid_volume) +
                          1717.0 * state.burnt_share * gas.energy;
    EXPECT_NEAR(stored, start + 1717.0 * state.burnt_share * fresh - work, 1e-7 * 1717.0 * fresh) << i;
  }
}

TEST(BurningMixture, GasAloneIsCompressedAlongItsAdiabat) {
  // The ideal gas against p v^gamma, in steps of falling length: second order.
  const ProductGas gas = ideal_gas();
  const BurningMixture law(unreacted_composition_b(), 1717.0, gas, tension_cutoff);
  const double gamma = 1.0 + 30.0 * gas_constant / 1200.0;
  const auto end = [&](int steps) {
    BurningState state = law.advance(law.unburnt(0.99), {0.99, 2.0, 1.0, 1200.0 * 1000.0});
    const double begin = state.pressure;
    for (int i = 0; i < steps; ++i)
      state = law.advance(state, {2.0 - 1.0 * i / steps, 2.0 - 1.0 * (i + 1) / steps, 0.0, 0.0});
    return state.valid ? state.pressure / (begin * std::pow(2.0, gamma)) - 1.0 : 1.0;
  };
  const double coarse = end(20), fine = end(40);
  EXPECT_LT(std::abs(fine), 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

TEST(BurningMixture, GasFillsTheVoidOfTornExplosive) {
  // Far beyond the tension cut-off: the explosive bears 5 MPa, the rest is void. Free expansion of little
  // gas.
  const BurningMixture law = mixture();
  const BurningState torn = law.unburnt(1.02);
  EXPECT_NEAR(torn.pressure, -tension_cutoff, 1.0);
  const double burnt = 1e-4;
  const BurningState state = law.advance(torn, {1.02, 1.02, burnt, specific_heat * 784.0});
  ASSERT_TRUE(state.valid);
  const double thin = 1717.0 * burnt / (1.02 - (1.0 - burnt) * state.solid_volume);
  EXPECT_NEAR(1.0 / state.gas_volume / thin, 1.0, 1e-6);
  EXPECT_NEAR(state.pressure, thin * 30.447 * gas_constant * state.gas_temperature, 0.02 * state.pressure);
  EXPECT_NEAR(state.gas_temperature, 784.0, 10.0);
}

TEST(BurningMixture, ModulusIsTheSlopeOfThePressure) {
  const BurningMixture law = mixture();
  const double volume = 1.1;
  BurningState state = law.unburnt(0.985);
  state = law.advance(state, {0.985, volume, 0.3, specific_heat * 784.0});
  const double d = 1e-4;
  const double up = law.advance(state, {volume, volume + d, 0, 0}).pressure,
               down = law.advance(state, {volume, volume - d, 0, 0}).pressure;
  EXPECT_NEAR(-volume * (up - down) / (2 * d) / state.bulk_modulus, 1.0, 1e-4);
}

/// The invariants of a step: shares and volumes add up, pressures are equal, and energy changes by what burnt
/// and by the work done.
void expect_step(const BurningMixture& law, const BurningState& before, const BurningState& after,
                 const BurningStep& step) {
  ASSERT_TRUE(after.valid);
  const double density = law.solid_density(), scale = density * after.burnt_share * 5.82e6;
  EXPECT_NEAR(after.burnt_share, std::min(1.0, before.burnt_share + step.burnt), 1e-15);
  EXPECT_NEAR(
      ((1.0 - after.burnt_share) * after.solid_volume + after.burnt_share * density * after.gas_volume) /
          step.volume_after,
      1.0, 1e-9);
  const GasState gas = law.gas_of(after);
  ASSERT_TRUE(gas.valid);
  EXPECT_NEAR(gas.pressure, after.pressure, 1e-6 * (std::abs(after.pressure) + 1e5));
  const double stored = (1.0 - after.burnt_share) * law.solid_energy(after.solid_volume) +
                        density * after.burnt_share * gas.energy;
  // Plus the round-off of the explosive's energy.
  EXPECT_NEAR(stored,
              before.energy + density * (after.burnt_share - before.burnt_share) * step.fresh_energy -
                  (after.work - before.work),
              1e-8 * scale + 1e-5);
  EXPECT_GT(after.gas_volume, 0.0);
  EXPECT_GT(after.solid_volume, 0.0);
  EXPECT_GT(after.bulk_modulus, 0.0);
}

TEST(BurningMixture, AStateOutsideOfTheLawIsInvalidAndStaysSo) {
  const BurningMixture law = mixture();
  // Gas that had 20 K where it was thin condenses at the density of the explosive.
  const BurningState cold = law.advance(law.unburnt(1.0), {1.0, 1.0, 0.5, specific_heat * 20.0});
  EXPECT_FALSE(cold.valid);
  EXPECT_FALSE(law.advance(cold, {1.0, 1.5, 0.1, specific_heat * 784.0}).valid);
  // 9000 K is where the table ends.
  EXPECT_FALSE(law.advance(law.unburnt(1.0), {1.0, 1.0, 1.0, specific_heat * 12000.0}).valid);
  EXPECT_FALSE(law.advance(law.unburnt(1.0), {1.0, std::nan(""), 0.5, specific_heat * 784.0}).valid);
}

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK

/// A number between two, in a thousand steps.
double between(double lower, double upper) {
  return lower + (upper - lower) * *rc::gen::inRange(0, 1001) / 1000.0;
}
double between_ratios(double lower, double upper) {
  return std::exp(between(std::log(lower), std::log(upper)));
}

/// What happens to a particle in a step: nothing burns, a trace or much of it, while it grows or shrinks.
BurningStep random_step(double volume, double share, double fresh) {
  const bool burns = share == 0.0 || *rc::gen::inRange(0, 2) == 1;
  const double burnt = burns ? between_ratios(1e-6, 1.0) : 0.0;
  const double strain = between_ratios(1e-6, 0.01);
  return {volume, volume * (*rc::gen::inRange(0, 2) == 1 ? 1.0 + strain : 1.0 - strain), burnt, fresh};
}

/// Whether the gas may leave its table on the way, as far as an adiabat tells.
bool is_near_the_ends(const BurningState& state) {
  return state.burnt_share > 0.0 && (state.gas_temperature < 450.0 || state.gas_temperature > 6000.0);
}

TEST(BurningMixtureProperties, EveryStepOnARandomWalkKeepsItsBalances) {
  const BurningMixture law = mixture();
  const bool fine = rc::check([&law] {
    const bool full = *rc::gen::inRange(0, 2) == 1;
    const double fresh = specific_heat * between(700.0, 784.0) + (full ? between(0.2, 0.8) * 5.82e6 : 0.0);
    double volume = between(0.88, 1.1);
    BurningState state = law.unburnt(volume);
    for (int i = 0; i < 40 && volume > 0.8 && volume < 20.0; ++i) {
      const BurningStep step = random_step(volume, state.burnt_share, fresh);
      const BurningState after = law.advance(state, step);
      if (!after.valid) {
        RC_ASSERT(is_near_the_ends(state));
        return;
      }
      expect_step(law, state, after, step);
      RC_ASSERT(!testing::Test::HasFailure());
      state = after;
      volume = step.volume_after;
    }
  });
  EXPECT_TRUE(fine);
}

#endif

}  // namespace
