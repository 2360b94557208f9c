// No law answers a denormal argument with NaN or infinity. Runs flush denormals; studies do not.
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/steel.hpp"
#include "support/visco_scram_update.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::materials;
using launchsafe::test_support::charge_update, launchsafe::test_support::step_of;

constexpr double denormals[] = {4.9e-324, 1e-320, 1e-310, 2e-308};

/// Sum of the state and losses of a solid after a step.
double solid_after(double crack_radius, double strain, double element, double dt) {
  const ViscoScramParameters solid;
  ViscoScramState<double> state{};
  state.crack_radius = crack_radius;
  for (auto& s : state.elements) s = {element, -element, element};
  const auto lost = charge_update(step_of(solid, dt), state, {strain, -strain, strain}, strain);
  return total_deviator(state).rx + state.crack_radius + lost.viscous + lost.crack;
}

TEST(Denormals, LeaveTheChargeFinite) {
  for (const double d : denormals) {
    EXPECT_TRUE(std::isfinite(solid_after(3e-5, d, 0.0, 1e-7))) << "strain " << d;
    EXPECT_TRUE(std::isfinite(solid_after(3e-5, 0.0, d, 1e-7))) << "stress " << d;
    EXPECT_TRUE(std::isfinite(solid_after(d, 1e-4, 1e7, 1e-7))) << "crack radius " << d;
    EXPECT_TRUE(std::isfinite(solid_after(3e-5, 1e-4, 1e7, d))) << "time step " << d;
    const JwlParameters m = unreacted_composition_b();
    EXPECT_TRUE(std::isfinite(jwl_isentropic_pressure(m, 1.0 + d))) << d;
  }
}

TEST(Denormals, LeaveTheSteelFinite) {
  const JohnsonCookParameters k;
  const MieGruneisenParameters m;
  for (const double d : denormals) {
    const auto small = johnson_cook_return<double>(k, {d, d, d}, d, 300.0, 1e-7);
    const auto large = johnson_cook_return<double>(k, {1e9, d, d}, d, 300.0, 1e-7);
    const auto quick = johnson_cook_return<double>(k, {1e9, d, d}, d, d, 1e-300);
    EXPECT_TRUE(std::isfinite(small.stress.rr + large.stress.rr + quick.stress.rr + large.plastic_work)) << d;
    const auto state = mie_gruneisen_compress<double>(m, 0.0, d, d, d, d);
    EXPECT_TRUE(std::isfinite(state.pressure + state.energy + mie_gruneisen_bulk_modulus<double>(m, d, d)))
        << d;
  }
}

}  // namespace
