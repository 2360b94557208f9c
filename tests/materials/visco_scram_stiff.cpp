// Visco-SCRAM where it is stiff: Maxwell elements from 1 ps to infinity, with and without cracks, against
// exact solutions.

// GCC 12 sees uninitialised registers in its own AVX-512 intrinsics as Eigen uses them (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"

#include "support/visco_scram_update.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace launchsafe::materials;
namespace math = launchsafe::math;
namespace test_support = launchsafe::test_support;
using MaxwellSolid = ViscoScramParameters;
using SolidState = test_support::ElementsState<double>;

constexpr double time_steps[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};  // s

/// The last element's relaxation time replaced.
MaxwellSolid solid_with(double tau) {
  MaxwellSolid solid;
  solid.relaxation_rates[maxwell_elements - 1] = 1.0 / tau;  // 0 for infinity
  return solid;
}

test_support::Dissipation advance_solid(const MaxwellSolid& solid, double dt, SolidState& state,
                                        double shear) {
  return test_support::charge_update(test_support::step_of(solid, dt), state, {0.0, 0.0, shear}, 0.0);
}

/// Elastic energy (J/m3) of the elements and of the open cracks: sum S_n:S_n/(4 G_n) + q S:S/(4 G).
double energy_of(const MaxwellSolid& solid, const SolidState& state) {
  const auto total = total_deviator(state);
  double energy = ViscoScram(solid).strain_ratio(state.crack_radius) * math::contract(total, total) /
                  (4.0 * solid.shear_modulus());
  for (std::size_t n = 0; n < maxwell_elements; ++n)
    energy += math::contract(state.elements[n], state.elements[n]) / (4.0 * solid.shear_moduli[n]);
  return energy;
}

// ---- without cracks ----

/// (1 - e^-x)/x and (x - 1 + e^-x)/x^2.
double mean_decay(double x) { return x > 0.0 ? -std::expm1(-x) / x : 1.0; }
double mean_response(double x) {
  if (x < 1e-2) return 0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0)));
  return (x + std::expm1(-x)) / (x * x);
}

class MaxwellElements : public testing::TestWithParam<double> {};

TEST_P(MaxwellElements, FollowARampAndItsRelaxationAndKeepTheLedger) {
  MaxwellSolid solid = solid_with(GetParam());
  solid.flaw_size = 0.0;
  constexpr double rate = 100.0;  // 1/s
  constexpr int loading = 100, all = 200;
  for (const double dt : time_steps) {
    SCOPED_TRACE(testing::Message() << "steps of " << dt << " s");
    const double load_time = loading * dt;
    double work = 0.0, lost = 0.0;
    for (std::size_t n = 0; n < maxwell_elements; ++n)
      work += 4.0 * solid.shear_moduli[n] * rate * rate * load_time * load_time *
              mean_response(load_time * solid.relaxation_rates[n]);
    SolidState state{};
    for (int k = 1; k <= all; ++k) {
      const auto loss = advance_solid(solid, dt, state, k <= loading ? rate * dt : 0.0);
      ASSERT_GE(loss.viscous, -1e-13 * work);
      lost += loss.viscous;
      for (std::size_t n = 0; n < maxwell_elements; ++n) {
        const double s = solid.relaxation_rates[n], loaded = std::min(k, loading) * dt;
        const double slope = 2.0 * solid.shear_moduli[n] * rate;
        const double exact =
            slope * loaded * mean_decay(loaded * s) * std::exp(-s * (k - std::min(k, loading)) * dt);
        ASSERT_NEAR(state.elements[n].rx, exact, 1e-12 * slope * load_time * mean_decay(load_time * s))
            << "element " << n << ", step " << k;
      }
    }
    EXPECT_NEAR(energy_of(solid, state) + lost, work, 1e-12 * work);
  }
}

INSTANTIATE_TEST_SUITE_P(RelaxationTimes, MaxwellElements,
                         testing::Values(1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2,
                                         0.1, 1.0, std::numeric_limits<double>::infinity()));

// ---- with cracks that do not grow ----

/// Shear stress over the sudden shear strain that it followed, for cracks at a fixed q. With the elastic
/// strains y_n of the elements, S_n = d_n y_n, d_n = 2 G_n:
/// (D + q d d^T/(2 G)) y' = d e' - D y/tau: symmetric, so its eigenvectors are exact.
class CrackedSolid {
 public:
  CrackedSolid(const MaxwellSolid& solid, double q) {
    for (int n = 0; n < size; ++n) {
      d_(n) = 2e-9 * solid.shear_moduli[static_cast<std::size_t>(n)];  // GPa
      loss_(n) = d_(n) * solid.relaxation_rates[static_cast<std::size_t>(n)];
    }
    const Matrix inertia = Matrix(d_.asDiagonal()) + (q / d_.sum()) * d_ * d_.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(Matrix(loss_.asDiagonal()), inertia);
    rates_ = solver.eigenvalues().cwiseMax(0.0);
    const Vector shares = solver.eigenvectors().transpose() * d_;
    weights_ = shares.cwiseAbs2();
    at_once_ = solver.eigenvectors() * shares;  // elastic strains right after a unit strain
  }
  /// Pa per unit strain.
  double stress(double time) const { return 1e9 * (weights_.array() * (-rates_.array() * time).exp()).sum(); }
  double element_at_once(std::size_t n) const {
    return 1e9 * d_(static_cast<int>(n)) * at_once_(static_cast<int>(n));
  }

 private:
  static constexpr int size = static_cast<int>(maxwell_elements);
  using Matrix = Eigen::Matrix<double, size, size>;
  using Vector = Eigen::Matrix<double, size, 1>;
  Vector d_, loss_, rates_, weights_, at_once_;
};

TEST(ViscoScramFrozenCrack, RelaxesBesideAnyShortElementAsTheEigenvectorsSay) {
  constexpr double strain = 1e-3;
  for (const double tau : {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6})
    for (const double q : {2.7e-5, 0.5, 27.0, 1000.0})
      for (const double dt : time_steps) {
        SCOPED_TRACE(testing::Message() << "tau " << tau << ", q " << q << ", steps of " << dt << " s");
        MaxwellSolid solid = solid_with(tau);
        solid.growth = false;
        const CrackedSolid exact(solid, q);
        SolidState state{};
        state.crack_radius = std::cbrt(q) * solid.flaw_size;
        for (std::size_t n = 0; n < maxwell_elements; ++n)
          state.elements[n].rx = strain * exact.element_at_once(n);
        const double largest = strain * exact.stress(0.0);
        for (int k = 1; k <= 5; ++k) {
          const auto loss = advance_solid(solid, dt, state, 0.0);
          EXPECT_NEAR(total_deviator(state).rx, strain * exact.stress(k * dt), 5e-3 * largest);
          EXPECT_GE(loss.viscous, -1e-13 * largest * strain);
        }
      }
}

}  // namespace
