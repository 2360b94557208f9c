// Visco-SCRAM against exact solutions of its own equations.

// GCC 12 sees uninitialised registers in its own AVX-512 intrinsics as Eigen uses them (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "support/visco_scram_update.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
using launchsafe::test_support::charge_update, launchsafe::test_support::step_of;
namespace math = launchsafe::math;

/// dS/dt = M S + b e of the elements at a fixed crack radius, from (I + (q/G) g 1^T) S' = 2 g e - S/tau, in
/// GPa.
struct FrozenSystem {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd loading;

  FrozenSystem(const ViscoScramParameters& m, double q) {
    constexpr int elements = 5;
    Eigen::MatrixXd left = Eigen::MatrixXd::Identity(elements, elements),
                    rates = Eigen::MatrixXd::Zero(elements, elements);
    Eigen::VectorXd moduli(elements);
    for (int n = 0; n < elements; ++n) {
      moduli(n) = m.shear_moduli[static_cast<std::size_t>(n)] / 1e9;
      rates(n, n) = m.relaxation_rates[static_cast<std::size_t>(n)];
    }
    left += q / moduli.sum() * moduli * Eigen::RowVectorXd::Ones(elements);
    matrix = -left.inverse() * rates;
    loading = left.inverse() * (2.0 * moduli);
  }

  /// Propagator of (S, 1) over dt under a constant strain rate.
  Eigen::MatrixXd propagator(double dt, double rate) const {
    Eigen::MatrixXd augmented = Eigen::MatrixXd::Zero(6, 6);
    augmented.topLeftCorner(5, 5) = matrix * dt;
    augmented.topRightCorner(5, 1) = loading * (rate * dt);
    return augmented.exp();
  }
};

ViscoScramParameters frozen(double q) {
  ViscoScramParameters m;
  m.growth = false;
  if (q <= 0.0) m.flaw_size = 0.0;
  return m;
}

ViscoScramState<double> cracked(const ViscoScramParameters& m, double q) {
  ViscoScramState<double> state{};
  state.crack_radius = std::cbrt(q) * m.flaw_size;
  return state;
}

/// Largest error of the shear stress over its largest value: a ramp for half the steps, then held; or,
/// `at_once`, a sudden strain that is held.
double frozen_error(double q, double dt, int steps, bool at_once) {
  const ViscoScramParameters m = frozen(q);
  const FrozenSystem system(m, q);
  const double rate = at_once ? 0.0 : 100.0;
  const Eigen::MatrixXd loaded = system.propagator(dt, rate), held = system.propagator(dt, 0.0);
  ViscoScramState<double> state = cracked(m, q);
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(6);
  exact(5) = 1.0;
  if (at_once) exact.head(5) = system.loading * 1e-3;
  for (std::size_t n = 0; n < maxwell_elements; ++n) state.elements[n].rx = 1e9 * exact(static_cast<int>(n));
  const ViscoScramStep law = step_of(m, dt);
  double worst = 0.0, largest = std::abs(exact.head(5).sum());
  for (int k = 0; k < steps; ++k) {
    const bool loading = k < steps / 2;
    charge_update(law, state, {0.0, 0.0, loading ? rate * dt : 0.0}, 0.0);
    exact = (loading ? loaded : held) * exact;
    const double stress = exact.head(5).sum();
    largest = std::max(largest, std::abs(stress));
    worst = std::max(worst, std::abs(1e-9 * total_deviator(state).rx - stress));
  }
  return worst / largest;
}

int steps_for(double dt) { return dt < 1e-7 ? 5000 : dt < 1e-5 ? 1000 : 20; }

constexpr double step_sizes[] = {1e-9, 1e-8, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3};

TEST(ViscoScramFrozenCrack, FollowsARampAndItsRelaxation) {
  for (const double q : {0.027, 0.3, 1.0, 27.0}) {
    for (const double dt : step_sizes)
      EXPECT_LE(frozen_error(q, dt, steps_for(dt), false), 1e-5) << q << " " << dt;
  }
}

TEST(ViscoScramFrozenCrack, RelaxesASuddenStrainToOneInAThousand) {
  for (const double q : {0.027, 0.1, 0.3, 1.0, 3.0, 27.0}) {
    for (const double dt : step_sizes)
      EXPECT_LE(frozen_error(q, dt, steps_for(dt), true), 1e-3) << q << " " << dt;
  }
}

TEST(ViscoScramFrozenCrack, ErrorFallsWithTheSquareOfTheStep) {
  const double coarse = frozen_error(1.0, 1e-7, 100, true), fine = frozen_error(1.0, 2.5e-8, 400, true);
  EXPECT_NEAR(std::log2(coarse / fine) / 2.0, 2.0, 0.1);
}

TEST(CrackGrowth, RateAndSlopeAreContinuousAtKPrime) {
  const ViscoScramParameters m;
  const double transition = m.toughness * std::sqrt(1.2);
  const auto speed = [&](double k) { return crack_growth_speed(m, k, m.toughness); };
  const double d = 1e-5 * transition;
  EXPECT_NEAR(speed(transition * (1.0 - 1e-12)) / speed(transition * (1.0 + 1e-12)), 1.0, 1e-10);
  const double below = (speed(transition) - speed(transition - d)) / d;
  const double above = (speed(transition + d) - speed(transition)) / d;
  EXPECT_NEAR(below / above, 1.0, 2e-4);
  EXPECT_NEAR(above, 2.0 * 300.0 / 1.2 / transition, 1e-3 * above);  // d/dK of v_max (1 - (K0/K)^2) at K'
}

TEST(CrackGrowth, PressureRaisesTheToughnessAndTensionDoesNot) {
  const ViscoScramParameters m;
  EXPECT_EQ(frictional_toughness(m, -1e8, 3e-5), m.toughness);
  EXPECT_GT(frictional_toughness(m, 1e7, 3e-5), m.toughness);
}

TEST(CrackGrowth, NeverHealsAndStopsAtTheBound) {
  ViscoScramParameters m;
  m.face_friction = 0.0;
  m.largest_crack_radius = 1e-3;
  ViscoScramState<double> state{};
  state.crack_radius = 2e-3;  // already beyond, from another scene's state
  for (int k = 0; k < 100; ++k) charge_update(step_of(m, 1e-7), state, {0.0, 0.0, 1e-2}, 0.0);
  EXPECT_EQ(state.crack_radius, 2e-3);
}

TEST(ViscoScram, NotANumberComesOutAsNotANumber) {
  const ViscoScramParameters m;
  ViscoScramState<double> state{};
  state.crack_radius = m.initial_crack_radius;
  charge_update(step_of(m, 1e-7), state, {std::nan(""), 0.0, 0.0}, 1e6);
  EXPECT_TRUE(std::isnan(math::von_mises(total_deviator(state))));
}

}  // namespace
