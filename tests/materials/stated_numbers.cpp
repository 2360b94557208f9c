// The laws against single numbers known to all their digits: half a unit of the last one is the tolerance.
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "support/jwl_energy_form.hpp"
#include "support/mie_gruneisen_pressure.hpp"
#include "support/visco_scram_update.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

namespace {

using namespace launchsafe::materials;
namespace test_support = launchsafe::test_support;

/// Half of the last digit's unit, and a hair.
double digits(double unit) { return 0.501 * unit; }

TEST(Jwl, HasTheStatedStatesOfTheUnreactedCharge) {
  // The temperature form of the same law at 298 K, nine digits, in Mbar.
  const JwlParameters m = unreacted_composition_b();
  const struct {
    double v, energy, pressure;
  } states[] = {{0.99, -6.18040254e-3, 1.03371865e-3}, {0.95, -6.30783693e-3, 6.71521900e-3}};
  for (const auto& state : states) {
    const double energy = test_support::jwl_energy_at_temperature(m, state.v, 2.487e6, 298.0);
    EXPECT_NEAR(energy / 1e11, state.energy, digits(1e-11)) << state.v;
    EXPECT_NEAR(test_support::jwl_pressure(m, state.v, energy) / 1e11, state.pressure, digits(1e-11))
        << state.v;
  }
  EXPECT_NEAR(m.initial_energy, -6.11861e8, digits(1e3));                // p(V = 1) = 0 solved for E
  EXPECT_NEAR(jwl_isentropic_pressure(m, 1.0), 0.0, 1.0);                // a charge at rest bears no pressure
  EXPECT_NEAR(jwl_bulk_modulus_at_rest(m) / 1e9, 10.297, digits(1e-3));  // -V dp/dV, dE = -p dV
}

TEST(VirialGas, HasTheStatedCoefficientsAndCompressibilities) {
  // Gamma series in 50 digits; agrees with Hirschfelder's table.
  EXPECT_NEAR(reduced_second_virial(1.0), -2.53808134, digits(1e-8));
  EXPECT_NEAR(reduced_second_virial(2.0), -0.627625288, digits(1e-9));
  EXPECT_NEAR(reduced_second_virial(5.0), 0.243343503, digits(1e-9));
  EXPECT_NEAR(reduced_second_virial(20.0), 0.525374204, digits(1e-9));
  // Eq. 37 corrected, three terms, of 1 mol in a kg.
  const ProductGas gas({{nitrogen(), 1.0}}, 1780.0);
  EXPECT_NEAR(gas.at(800.0, 100e-6).compressibility, 1.37323443, digits(1e-8));
  EXPECT_NEAR(gas.at(1500.0, 50e-6).compressibility, 2.07576984, digits(1e-8));
}

TEST(MieGruneisen, HasTheStatedHugoniot) {
  // Eq. 19 with s - 1, and p_H mu/(2 rho0 (1 + mu)); one step from rest does the work of a shock.
  const MieGruneisenParameters m;
  const auto shocked = [&m](double mu) {
    return detail::compress_by_mean_pressure(m, 0.0, 0.0, 0.0, mu, 0.0);
  };
  EXPECT_NEAR(shocked(0.001).pressure / 1e9, 0.166814, digits(1e-6));
  EXPECT_NEAR(shocked(0.01).pressure / 1e9, 1.705489, digits(1e-6));
  EXPECT_NEAR(shocked(0.1).pressure / 1e9, 21.300845, digits(1e-6));
  EXPECT_NEAR(shocked(0.01).energy, 1078.291, digits(1e-3));
  EXPECT_NEAR(test_support::hugoniot_pressure(m, 0.1) / 1e9, 21.300845, digits(1e-6));
}

TEST(CrackGrowth, HasTheStatedSpeeds) {
  // The growth law with K1 = K' (1 + m/2)^(1/m) = 655202.812.
  const ViscoScramParameters m;
  const auto speed = [&](double intensity) { return test_support::growth_speed(m, intensity); };
  EXPECT_NEAR(speed(3e5), 0.1215, digits(1e-4));
  EXPECT_NEAR(speed(5e5), 20.09388, digits(1e-5));
  EXPECT_NEAR(speed(1e6), 225.0, 1e-9);
  EXPECT_NEAR(speed(547722.5575051661), 50.0, 1e-9);  // K', where both branches give v_max/(1 + m/2)
  EXPECT_NEAR(speed(0.5 * 655202.812) / (300.0 / 1024.0), 1.0, 1e-6);  // v_max (1/2)^10
}

TEST(CrackGrowth, HasTheStatedToughnessUnderFriction) {
  // K0 sqrt[1 + (pi A/K0)(1 + A/K0)] = 1.827012e6 at 141 MPa, c = 30 um: K' is sqrt(1.2) of it.
  const double transition = 1.827012e6 * std::sqrt(1.2);
  EXPECT_NEAR(test_support::growth_speed(ViscoScramParameters{}, transition, 141e6), 50.0, 2e-4);
}

TEST(Kinetics, HasTheStatedAdiabaticInductionTimes) {
  // To 2000 K with the printed activation temperature: the integral of dT over the heating rate.
  KineticsParameters printed;
  printed.activation_temperature = 2.7e4;
  const auto induction = [&](double from) {
    return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        [&](double temperature) { return 1.0 / arrhenius_heating(printed, 1780.0, temperature); }, from,
        2000.0, 15, 1e-10);
  };
  EXPECT_NEAR(induction(600.0), 7.425578e-2, digits(1e-8));
  EXPECT_NEAR(induction(650.0), 2.746044e-3, digits(1e-9));
  EXPECT_NEAR(induction(700.0), 1.645534e-4, digits(1e-10));
  EXPECT_NEAR(induction(750.0), 1.449736e-5, digits(1e-11));
}

}  // namespace
