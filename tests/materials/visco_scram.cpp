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

/// dS/dt = M S + b e for the first elements, as many as are asked for, at a fixed crack radius, from (I +
/// (q/G) g 1^T) S' = 2 g e - S/tau, in GPa.
struct FrozenSystem {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd loading;

  FrozenSystem(const ViscoScramParameters& m, double q, int elements = 5) {
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

TEST(ViscoScramFrozenCrack, RateBeyondRoundOffEndsToo) {
  // Sub-steps of 1e-30 s would leave the time left unchanged for ever.
  ViscoScramParameters m = frozen(0.5);
  m.relaxation_rates[4] = 1e30;
  ViscoScramState<double> state = cracked(m, 0.5);
  charge_update(step_of(m, 1e-7), state, {0.0, 0.0, 1e-3}, 0.0);
  EXPECT_GT(total_deviator(state).rx, 0.0);
}

TEST(ViscoScramFrozenCrack, OnlyStrainThatChangesWithinAStepDividesIt) {
  // Two relaxation times of the fastest element a step, at the crack strain that couples most.
  const double dt = 1e-6, rate = 1.0;
  const ViscoScramParameters m = frozen(0.5);
  const ViscoScramStep law = step_of(m, dt);
  ViscoScramState<double> state = cracked(m, 0.5);
  const double q = crack_strain_ratio(m, state.crack_radius);
  const auto is_whole = [&](double strain) {
    ViscoScramState<double> whole = state, end = state;
    ViscoScramDissipation<double> lost;
    relax(m, whole, Deviator<double>{0.0, 0.0, strain}, q, q, relaxation(m, dt), lost);
    charge_update(law, end, {0.0, 0.0, strain}, 0.0);
    return std::abs(end.elements.back().rx / whole.elements.back().rx - 1.0) < 1e-12;
  };
  EXPECT_FALSE(is_whole(rate * dt));
  for (int k = 0; k < 1000; ++k) charge_update(law, state, {0.0, 0.0, rate * dt}, 0.0);
  EXPECT_TRUE(is_whole(rate * dt));
  EXPECT_TRUE(is_whole(1.05 * rate * dt));
  EXPECT_FALSE(is_whole(10.0 * rate * dt));
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

TEST(CrackGrowth, WholeAndFractionalExponentsAgree) {
  ViscoScramParameters whole, fractional;
  fractional.growth_exponent = 10.0 * (1.0 + 1e-14);
  for (const double k : {1e4, 2e5, 5e5, 9e5}) {
    EXPECT_NEAR(crack_growth_speed(whole, k, 5e5) / crack_growth_speed(fractional, k, 5e5), 1.0, 1e-12);
  }
}

TEST(CrackGrowth, PressureRaisesTheToughnessAndTensionDoesNot) {
  const ViscoScramParameters m;
  EXPECT_EQ(frictional_toughness(m, -1e8, 3e-5), m.toughness);
  EXPECT_GT(frictional_toughness(m, 1e7, 3e-5), m.toughness);
}

/// Crack radius after shearing at a constant rate (1/s) for `time`, without friction.
ViscoScramState<double> sheared(double rate, double time, int steps) {
  ViscoScramParameters m;
  m.face_friction = 0.0;
  ViscoScramState<double> state{};
  state.crack_radius = m.initial_crack_radius;
  const ViscoScramStep law = step_of(m, time / steps);
  for (int k = 0; k < steps; ++k) charge_update(law, state, {0.0, 0.0, rate * time / steps}, 0.0);
  return state;
}

TEST(CrackGrowth, ConvergesToAFineReferenceThroughTheRunaway) {
  // The times at which c passes 0.1 mm, a little before the stress peaks (found with steps of 1 ns).
  const struct { double rate, time; } cases[] = {{50.0, 1.85312e-4}, {500.0, 1.711e-5}, {5000.0, 1.615e-6}};
  for (const auto& c : cases) {
    const auto reference = sheared(c.rate, c.time, 400000);
    for (const int steps : {100, 400, 1600, 6400}) {
      const auto state = sheared(c.rate, c.time, steps);
      EXPECT_NEAR(state.crack_radius / reference.crack_radius, 1.0, 3e-3) << c.rate << " " << steps;
      EXPECT_NEAR(total_deviator(state).rx / total_deviator(reference).rx, 1.0, 1e-5)
          << c.rate << " " << steps;
    }
  }
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

TEST(ViscoScramFrozenCrack, ShortRelaxationTakesFewSubSteps) {
  // tau = 1 ps in a step of 0.1 ms: 1e8 relaxation times, for which sub-steps of a share of tau would take
  // longer than a test may. What relaxes so fast is gone after the step, and the rest is as if it had never
  // been there.
  for (const double q : {0.5, 27.0, 1000.0}) {
    ViscoScramParameters m = frozen(q), without = m;
    m.relaxation_rates[4] = 1e12;
    without.shear_moduli[4] = 0.0;
    without.relaxation_rates[4] = 0.0;
    const double strain = 1e-3, dt = 1e-4;
    const FrozenSystem whole(m, q);
    ViscoScramState<double> state = cracked(m, q);
    const Eigen::VectorXd sudden = whole.loading * strain;
    for (std::size_t n = 0; n < maxwell_elements; ++n)
      state.elements[n].rx = 1e9 * sudden(static_cast<int>(n));
    const auto lost = charge_update(step_of(m, dt), state, {}, 0.0);
    EXPECT_GE(lost.viscous, 0.0);
    // The other four with the same crack strain q S/(2 G): q' = q (G - G_5)/G of their own modulus.
    const double reduced = q * without.shear_modulus() / m.shear_modulus();
    const FrozenSystem four(without, reduced, 4);
    const Eigen::MatrixXd propagator = (four.matrix * dt).exp();
    const double exact = 1e9 * (propagator * four.loading * strain).sum();
    EXPECT_NEAR(total_deviator(state).rx / exact, 1.0, 1e-3) << q;
  }
}

}  // namespace
