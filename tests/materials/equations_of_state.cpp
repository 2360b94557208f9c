#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "support/jwl_energy_form.hpp"
#include "support/mie_gruneisen_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace launchsafe::materials;
using launchsafe::test_support::composition_b_products, launchsafe::test_support::hugoniot_energy,
    launchsafe::test_support::hugoniot_pressure, launchsafe::test_support::mie_gruneisen_pressure;

TEST(Jwl, BulkModulusIsTheSlopeOfTheIsentrope) {
  for (const JwlParameters& m : {unreacted_composition_b(), composition_b_products()}) {
    for (const double v : {0.8, 0.95, 1.0, 1.02}) {
      const double d = 1e-5 * v;
      const double slope =
          (jwl_isentropic_pressure(m, v + d) - jwl_isentropic_pressure(m, v - d)) / (2.0 * d);
      EXPECT_NEAR(-v * slope / jwl_isentropic_bulk_modulus(m, v), 1.0, 1e-7) << v;
    }
  }
}

TEST(MieGruneisen, BulkModulusIsTheSlopeOfTheAdiabat) {
  const MieGruneisenParameters m;
  for (const double mu : {0.0, 0.01, 0.1, 0.3}) {
    const double energy = hugoniot_energy(m, mu) + 2000.0, pressure = mie_gruneisen_pressure(m, mu, energy);
    const double d = 1e-6;
    const double up = mie_gruneisen_compress(m, mu, pressure, energy, mu + d, 0.0).pressure;
    const double modulus = (1.0 + mu) * (up - pressure) / d;
    EXPECT_NEAR(modulus / mie_gruneisen_bulk_modulus(m, mu, pressure), 1.0, 2e-5) << mu;
  }
  EXPECT_NEAR(mie_gruneisen_bulk_modulus(m, -0.01, 0.0), 0.99 * 7830.0 * 4610.0 * 4610.0, 1.0);
}

TEST(MieGruneisen, HeatOfALargeStepIsNotLost) {
  // At constant density all of it becomes energy. From v = v0 to 2 v0, w = v/v0, what comes in evenly in ln w
  // does work on the way, -Gamma e dw: integral of h exp(-Gamma (2 - w))/(w ln 2) dw from 1 to 2, here by
  // Simpson's rule.
  const MieGruneisenParameters m;
  EXPECT_NEAR(mie_gruneisen_compress(m, 0.0, 0.0, 0.0, 0.0, 1000.0).energy, 1000.0, 1e-9);
  const auto cold = mie_gruneisen_compress(m, 0.0, 0.0, 0.0, -0.5, 0.0);
  const auto warm = mie_gruneisen_compress(m, 0.0, 0.0, 0.0, -0.5, 1000.0);
  double expected = 0.0;
  constexpr int intervals = 1000;
  for (int k = 0; k <= intervals; ++k) {
    const double w = 1.0 + static_cast<double>(k) / intervals;
    const double weight = k == 0 || k == intervals ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    expected +=
        weight / (3.0 * intervals) * 1000.0 * std::exp(-m.gruneisen * (2.0 - w)) / (w * std::log(2.0));
  }
  EXPECT_NEAR((warm.energy - cold.energy) / expected, 1.0, 1e-5);
}

TEST(MieGruneisen, StepIsTheOneWrittenWithItsDivisions) {
  // e1 (1 + h G) = e0 + heat - h (p0 + p_H - G e_H), p1 = p_H + G (e1 - e_H), h = dv/2: to round-off of the
  // modulus and of an energy of 1e4 J/kg.
  const MieGruneisenParameters m;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share;
  for (int k = 0; k < 10000; ++k) {
    const double mu0 = -0.05 + 0.2 * share(random), mu1 = mu0 + 0.01 * (share(random) - 0.5);
    const double energy0 = 1e4 * share(random), heat = 100.0 * share(random);
    const double pressure0 = mie_gruneisen_pressure(m, mu0, energy0);
    const auto state = mie_gruneisen_compress(m, mu0, pressure0, energy0, mu1, heat);
    const double h = 0.5 * (mu0 - mu1) / (m.density * (1.0 + mu0) * (1.0 + mu1)), g = m.gruneisen * m.density;
    const double cold = hugoniot_pressure(m, mu1) - g * hugoniot_energy(m, mu1);
    const double energy = (energy0 + heat - h * (pressure0 + cold)) / (1.0 + h * g);
    ASSERT_NEAR(state.energy, energy, 1e-14 * 1e4);
    ASSERT_NEAR(state.pressure, cold + g * energy, 1e-15 * 1.66e11);
  }
}

TEST(MieGruneisen, IsContinuousThroughRestDensityAtAnyEnergy) {
  // Between mu = -d and d the pressure may change by the slope's 2 d rho0 c0^2 and no more.
  const MieGruneisenParameters m;
  const double modulus = m.density * m.sound_speed * m.sound_speed;
  for (const double energy : {-1e5, 0.0, 1e3, 1e5, 1e6}) {
    EXPECT_NEAR(mie_gruneisen_pressure(m, 0.0, energy), 1.67 * 7830.0 * energy,
                1e-9 * std::abs(energy) * 7830.0);
    for (const double d : {1e-3, 1e-6, 1e-9}) {
      const double jump = mie_gruneisen_pressure(m, d, energy) - mie_gruneisen_pressure(m, -d, energy);
      const double round_off = 4e-16 * 1.67 * 7830.0 * std::abs(energy);
      EXPECT_NEAR(jump / (2.0 * d * modulus), 1.0, 3.0 * d + round_off / (2.0 * d * modulus))
          << energy << " " << d;
    }
  }
}

TEST(MieGruneisen, BulkModulusIsContinuousThroughRestDensity) {
  const MieGruneisenParameters m;
  for (const double energy : {0.0, 1e3, 1e5, 1e6}) {
    const auto modulus = [&](double mu) {
      return mie_gruneisen_bulk_modulus(m, mu, mie_gruneisen_pressure(m, mu, energy));
    };
    EXPECT_NEAR(modulus(-1e-9) / modulus(1e-9), 1.0, 1e-7) << energy;
    // rho0 (c0^2 + Gamma^2 e), of the derivation in the header.
    EXPECT_NEAR(modulus(0.0) / (7830.0 * (4610.0 * 4610.0 + 1.67 * 1.67 * energy)), 1.0, 1e-14) << energy;
  }
}

TEST(MieGruneisen, StepsThroughRestDensityAreMonotoneBothWays) {
  // Hot steel, e up to some thousand kelvin, unloads into tension and is compressed again in steps of 1e-5.
  const MieGruneisenParameters m;
  for (const double heat : {0.0, 1e4, 1e6}) {
    double mu = 0.002;
    MieGruneisenState<double> state{mie_gruneisen_pressure(m, mu, heat), heat};
    for (const double change : {-1e-5, 1e-5}) {
      for (int k = 0; k < 400; ++k) {
        const double next = mu + change;
        const auto after = mie_gruneisen_compress(m, mu, state.pressure, state.energy, next, 0.0);
        const double stiffness = (after.pressure - state.pressure) / change;
        EXPECT_NEAR(stiffness * (1.0 + mu) / mie_gruneisen_bulk_modulus(m, mu, state.pressure), 1.0, 1e-3)
            << heat << " " << mu;
        state = after;
        mu = next;
      }
    }
    EXPECT_NEAR(state.pressure, mie_gruneisen_pressure(m, 0.002, heat), 1e-3 * 0.002 * 1.66e11) << heat;
  }
}

TEST(MieGruneisen, TensionIsLargestWhereTheHeaderSays) {
  // p(w) = -rho0 c0^2 integral of exp(-Gamma (w - u))/u^2 du from 1 to w, whose least value was found by
  // Simpson's rule: -36.56 GPa at w = 1.65.
  const MieGruneisenParameters m;
  const auto bears = [&](double w) {
    return mie_gruneisen_compress(m, 0.0, 0.0, 0.0, 1.0 / w - 1.0, 0.0).pressure;
  };
  EXPECT_NEAR(bears(1.65) / 1e9, -36.56, 0.01);
  EXPECT_LT(bears(1.65), bears(1.55));
  EXPECT_LT(bears(1.65), bears(1.75));
  EXPECT_EQ(mie_gruneisen_bulk_modulus(m, 1.0 / 1.7 - 1.0, bears(1.7)), 0.0);
  EXPECT_GT(mie_gruneisen_bulk_modulus(m, 1.0 / 1.6 - 1.0, bears(1.6)), 0.0);
}

TEST(VirialGas, DiluteGasIsIdeal) {
  const GasState state = ProductGas({{water(), 1.0}}, 1780.0).at(600.0, 1.0);
  EXPECT_TRUE(state.valid);
  EXPECT_NEAR(state.pressure, gas_constant * 600.0, 0.2);
  EXPECT_NEAR(state.compressibility, 1.0, 1e-4);
}

TEST(VirialGas, PressureThatFallsOnCompressionIsAReportedLimit) {
  // The products at 300 K: Z is still 0.075 at 300 kg/m3, but the pressure is below that at 100 kg/m3.
  const ProductGas products(composition_b_gas(), 1780.0);
  const GasState thin = products.at(300.0, 1.0 / 100.0), dense = products.at(300.0, 1.0 / 300.0);
  EXPECT_TRUE(thin.valid);
  EXPECT_GT(dense.compressibility, 0.0);
  EXPECT_LT(dense.compressibility * 300.0, thin.compressibility * 100.0);
  EXPECT_FALSE(dense.valid);
}

TEST(ReactionDegree, RisesLinearlyBetweenItsTemperatures) {
  KineticsParameters k;
  k.ignition_temperature = 525.0;
  EXPECT_EQ(reaction_degree(k, 524.9), 0.0);
  EXPECT_NEAR(reaction_degree(k, 0.5 * (525.0 + 784.0)), 0.5, 1e-14);
  EXPECT_EQ(reaction_degree(k, 785.0), 1.0);
  EXPECT_TRUE(std::isnan(reaction_degree(k, std::nan(""))));
}

TEST(ReactionDegree, WithoutATriggerOnlyTheBurntTemperatureCounts) {
  KineticsParameters k;
  k.ignition_temperature = INFINITY;
  EXPECT_EQ(reaction_degree(k, 700.0), 0.0);
  EXPECT_EQ(reaction_degree(k, 790.0), 1.0);
}

TEST(MieGruneisen, LargeStepIsThatOfManySmallOnes) {
  // From a tenfold volume to double density, where one mean of two pressures changed the sign of the energy.
  const MieGruneisenParameters m;
  const double mu0 = -0.9, mu1 = 1.0, pressure0 = mie_gruneisen_pressure(m, mu0, 0.0);
  MieGruneisenState<double> fine{pressure0, 0.0};
  constexpr int steps = 100000;
  for (int k = 0; k < steps; ++k) {
    const auto mu = [&](int step) {
      return (1.0 + mu0) * std::pow((1.0 + mu1) / (1.0 + mu0), double(step) / steps) - 1.0;
    };
    fine = mie_gruneisen_compress(m, mu(k), fine.pressure, fine.energy, mu(k + 1), 0.0);
  }
  const auto once = mie_gruneisen_compress(m, mu0, pressure0, 0.0, mu1, 0.0);
  // Parts of 0.5 % are steps of Gamma dw = 0.08 at the tenfold volume, w = v/v0: errors of its square,
  // halved.
  EXPECT_NEAR(once.energy / fine.energy, 1.0, 4e-3);
  EXPECT_NEAR(once.pressure / fine.pressure, 1.0, 4e-3);
}

}  // namespace
