// The polynomial for the isentrope against the closed form it stands in for.
#include "support/jwl_energy_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Pack;
using launchsafe::test_support::composition_b_products, launchsafe::test_support::jwl_pressure;

/// Round-off of the closed form: the sizes of its terms times that of doubles.
double round_off(const JwlParameters& m, double v) {
  const double thermal = m.omega * (m.initial_energy - jwl_cold_energy(m, 1.0));
  return 0x1p-52 * (m.a * std::exp(-m.r1 * v) + std::abs(m.b) * std::exp(-m.r2 * v) +
                    std::abs(thermal) * std::pow(v, -1.0 - m.omega));
}

JwlParameters stiff(double r1) {
  JwlParameters m = unreacted_composition_b();
  m.a *= std::exp(r1 - m.r1);  // the same first term at V = 1
  m.r1 = r1;
  m.initial_energy = -jwl_pressure(m, 1.0, 0.0) / m.omega;
  return m;
}

TEST(JwlIsentrope, IsTheClosedFormInsideAndOutsideItsInterval) {
  for (const JwlParameters& m :
       {unreacted_composition_b(), composition_b_products(), stiff(16.0), stiff(60.0)}) {
    const JwlIsentrope isentrope(m);
    for (int k = -400; k <= 400; ++k) {
      const double x = 1e-3 * k, v = 1.0 + x;
      // Both round: four each, and V itself by half a unit, which the slope multiplies.
      const double slope = jwl_isentropic_bulk_modulus(m, v) / v;
      EXPECT_NEAR(isentrope.pressure(x), jwl_isentropic_pressure(m, v),
                  8.0 * round_off(m, v) + 0x1p-53 * std::abs(slope) * (1.0 + m.r1))
          << v;
    }
  }
}

TEST(JwlIsentrope, RestIsFreeOfStressAndTheSlopeIsTheBulkModulus) {
  const JwlParameters m = unreacted_composition_b();
  const JwlIsentrope isentrope(m);
  EXPECT_EQ(isentrope.pressure(0.0), 0.0);
  EXPECT_NEAR(-isentrope.pressure(1e-12) / 1e-12 / jwl_bulk_modulus_at_rest(m), 1.0, 1e-10);
}

TEST(JwlIsentrope, VolumeThatIsNoneGivesNoPressure) {
  const JwlIsentrope isentrope(unreacted_composition_b());
  for (const double x : {-1.0, -1.3, -6.0, std::nan("")}) EXPECT_TRUE(std::isnan(isentrope.pressure(x))) << x;
}

TEST(JwlIsentrope, LaneOutsideLeavesTheOthersAlone) {
  const JwlIsentrope isentrope(unreacted_composition_b());
  Pack x(-0.01);
  x.set(1, -0.7);
  const Pack pressure = isentrope.pressure(x);
  EXPECT_EQ(pressure[0], isentrope.pressure(-0.01));
  EXPECT_EQ(pressure[0], isentrope.pressure(Pack(-0.01))[0]);
  EXPECT_NEAR(pressure[1] / isentrope.pressure(-0.7), 1.0, 1e-13);
}

}  // namespace
