#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "support/jwl_energy_form.hpp"
#include "support/mie_gruneisen_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
