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
using namespace launchsafe::test_support;
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

ElementsState<double> cracked(const ViscoScramParameters& m, double q) {
  ElementsState<double> state{};
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
  ElementsState<double> state = cracked(m, q);
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(6);
  exact(5) = 1.0;
  if (at_once) exact.head(5) = system.loading * 1e-3;
  for (std::size_t n = 0; n < maxwell_elements; ++n) state.elements[n].rx = 1e9 * exact(static_cast<int>(n));
  const ViscoScram law = step_of(m, dt);
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
  const auto speed = [&](double k) { return growth_speed(m, k); };
  const double d = 1e-5 * transition;
  EXPECT_NEAR(speed(transition * (1.0 - 1e-12)) / speed(transition * (1.0 + 1e-12)), 1.0, 1e-10);
  const double below = (speed(transition) - speed(transition - d)) / d;
  const double above = (speed(transition + d) - speed(transition)) / d;
  EXPECT_NEAR(below / above, 1.0, 2e-4);
  EXPECT_NEAR(above, 2.0 * 300.0 / 1.2 / transition, 1e-3 * above);  // d/dK of v_max (1 - (K0/K)^2) at K'
}

TEST(CrackGrowth, PressureRaisesTheToughnessAndTensionDoesNot) {
  const ViscoScramParameters m;
  EXPECT_EQ(growth_speed(m, 6e5, -1e8), growth_speed(m, 6e5));
  EXPECT_LT(growth_speed(m, 6e5, 1e7), growth_speed(m, 6e5));
}

/// Rates of the paper's equations under a shear rate (1/s) and a pressure (Pa): of S_n (Pa), and last of c
/// (m).
using Solid = std::array<double, maxwell_elements + 1>;
Solid rates_of(const ViscoScramParameters& m, const Solid& at, double shear_rate, double pressure) {
  const double c = at.back(), q = std::pow(c / m.flaw_size, 3.0), pi = std::acos(-1.0);
  double stress = 0.0, relaxing = 0.0;
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    stress += at[n];
    relaxing += m.relaxation_rates[n] * at[n];
  }
  const double k = std::sqrt(3.0 * pi * c) * std::abs(stress), e = m.growth_exponent;
  const double mu =
      m.face_friction * std::sqrt(45.0 / (2.0 * (3.0 - 2.0 * m.face_friction * m.face_friction)));
  const double a = mu * pressure * std::sqrt(c) / m.toughness;
  const double k0 = m.toughness * std::sqrt(1.0 + pi * a * (1.0 + a)),
               transition = k0 * std::sqrt(1.0 + 2.0 / e);
  const double v = k < transition ? std::pow(k / (transition * std::pow(1.0 + 0.5 * e, 1.0 / e)), e)
                                  : 1.0 - std::pow(k0 / k, 2.0);
  Solid rates{};
  rates.back() = m.largest_growth_speed * v;
  const double more = 3.0 * q * rates.back() / c, g = m.shear_modulus();
  const double stress_rate = (2.0 * g * shear_rate - more * stress - relaxing) / (1.0 + q);
  const double applied = shear_rate - 0.5 / g * (more * stress + q * stress_rate);
  for (std::size_t n = 0; n < maxwell_elements; ++n)
    rates[n] = 2.0 * m.shear_moduli[n] * applied - m.relaxation_rates[n] * at[n];
  return rates;
}

/// By the classical Runge-Kutta method.
Solid solution(const ViscoScramParameters& m, double shear_rate, double pressure, double time, int steps) {
  Solid at{};
  at.back() = m.initial_crack_radius;
  const auto moved = [](Solid from, const Solid& rates, double by) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] += by * rates[i];
    return from;
  };
  const double h = time / steps;
  for (int k = 0; k < steps; ++k) {
    const Solid a = rates_of(m, at, shear_rate, pressure);
    const Solid b = rates_of(m, moved(at, a, 0.5 * h), shear_rate, pressure);
    const Solid c = rates_of(m, moved(at, b, 0.5 * h), shear_rate, pressure);
    const Solid d = rates_of(m, moved(at, c, h), shear_rate, pressure);
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
  }
  return at;
}

TEST(CrackGrowth, FollowsTheEquationsSlowAndRunningAway) {
  struct Case {
    double rate, pressure, time;  // 1/s, Pa, s
    double growth_exponent;
    double accuracy;
  };
  for (const Case& each : {Case{200.0, 0.0, 30e-6, 10.0, 1e-5}, Case{1000.0, 0.0, 10e-6, 10.0, 3e-4},
                           Case{1000.0, 0.0, 10e-6, 7.0, 3e-4}, Case{1000.0, 5e6, 20e-6, 4.6, 3e-4}}) {
    ViscoScramParameters m;
    m.growth_exponent = each.growth_exponent;
    constexpr int steps = 100;
    const ViscoScram law = step_of(m, each.time / steps);
    ElementsState<double> state{};
    state.crack_radius = m.initial_crack_radius;
    for (int k = 0; k < steps; ++k)
      charge_update(law, state, {0.0, 0.0, each.rate * each.time / steps}, each.pressure);
    const Solid exact = solution(m, each.rate, each.pressure, each.time, 20000);
    EXPECT_NEAR(state.crack_radius / exact.back(), 1.0, each.accuracy) << each.rate;
    double stress = 0.0;
    for (std::size_t n = 0; n < maxwell_elements; ++n) stress += exact[n];
    EXPECT_NEAR(total_deviator(state).rx / stress, 1.0, 10.0 * each.accuracy) << each.rate;
  }
}

TEST(CrackGrowth, NeverHealsAndStopsAtTheBound) {
  ViscoScramParameters m;
  m.face_friction = 0.0;
  m.largest_crack_radius = 1e-3;
  ElementsState<double> state{};
  state.crack_radius = 2e-3;  // already beyond, from another scene's state
  for (int k = 0; k < 100; ++k) charge_update(step_of(m, 1e-7), state, {0.0, 0.0, 1e-2}, 0.0);
  EXPECT_EQ(state.crack_radius, 2e-3);
}

TEST(ViscoScram, NotANumberComesOutAsNotANumber) {
  const ViscoScramParameters m;
  ElementsState<double> state{};
  state.crack_radius = m.initial_crack_radius;
  charge_update(step_of(m, 1e-7), state, {std::nan(""), 0.0, 0.0}, 1e6);
  EXPECT_TRUE(std::isnan(math::von_mises(total_deviator(state))));
}

}  // namespace
