// Steel on a smooth path that turns in strain space: strength and pressure converge with the step. That the
// charge does is in visco_scram.cpp, extreme_states.cpp and tests/error_of_parts.
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/steel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
namespace math = launchsafe::math;

constexpr double strain_rate = 2000.0, path_time = 1e-5;  // 1/s, s
constexpr double stress_scale = 1e9;                      // Pa

/// Calls step(middle of the step as a share of its time, its length in s) for the whole path.
template <class Step>
void drive(int steps, Step&& step) {
  for (int k = 0; k < steps; ++k) step((k + 0.5) / steps, path_time / steps);
}

Deviator<double> stress_after(int steps) {
  const JohnsonCookParameters law;
  Deviator<double> stress{};
  double plastic_strain = 0.0, temperature = 300.0;
  drive(steps, [&](double share, double dt) {
    const double width = strain_rate * dt;
    const Deviator<double> strain{width * std::cos(3.0 * share), -0.3 * width * (1.0 + share),
                                  width * std::sin(2.0 * share)};
    const auto result =
        johnson_cook_return(law, stress + 2.0 * law.shear_modulus * strain, plastic_strain, temperature, dt);
    stress = result.stress;
    plastic_strain += result.plastic_strain_increment;
    temperature += law.taylor_quinney / (7830.0 * law.specific_heat) * result.plastic_work;
  });
  return stress;
}

double pressure_after(int steps) {
  const MieGruneisenParameters law;
  double mu = 0.0;
  MieGruneisenState<double> state{0.0, 0.0};
  drive(steps, [&](double share, double dt) {
    const double next = mu + strain_rate * dt * (0.5 + share);
    state = mie_gruneisen_compress(law, mu, state.pressure, state.energy, next, 0.0);
    mu = next;
  });
  return state.pressure;
}

/// From the errors of 200 and 800 steps; the first is at most a hundredth of the stress scale.
template <class Error>
double order_of(const Error& error) {
  const double coarse = error(200), fine = error(800);
  EXPECT_LE(coarse, 1e-2 * stress_scale);
  return std::log2(coarse / fine) / 2.0;
}

TEST(JohnsonCookReturn, IsOfFirstOrderInTheStep) {
  // Implicit Euler in the plastic strain.
  const Deviator<double> reference = stress_after(25600);
  EXPECT_GE(order_of([&](int steps) { return math::von_mises(stress_after(steps) - reference); }), 0.9);
}

TEST(MieGruneisen, IsOfSecondOrderInTheStep) {
  const double reference = pressure_after(25600);
  EXPECT_GE(order_of([&](int steps) { return std::abs(pressure_after(steps) - reference); }), 1.9);
}

}  // namespace
