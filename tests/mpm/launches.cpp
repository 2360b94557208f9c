// Momentum, energy and frames of the assembled projectile, in either formulation.
#include "exact_solutions.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace launchsafe;
using namespace launchsafe::test_support;

class Launches : public testing::TestWithParam<scene::Formulation> {
 protected:
  static scene::Scene shell(double cell_size) {
    scene::Scene shell = shell_155(cell_size);
    shell.numerics.formulation = GetParam();
    return shell;
  }
  static bool on_lattice() { return GetParam() == scene::Formulation::total_lagrangian; }
};

INSTANTIATE_TEST_SUITE_P(Formulations, Launches, testing::ValuesIn(both_formulations),
                         [](const auto& test) { return name_of(test.param); });

TEST_P(Launches, AccelerateThePressureTimesAreaOverMass) {
  // 496 MPa on the 155 mm shell in the lab frame: p A/m in m/s2, and as setback pressure 1717 kg/m3 0.56 m a.
  const struct {
    scene::Symmetry symmetry;
    double expected;
  } shells[] = {{scene::Symmetry::axisymmetric, 1.46479e5},
                {scene::Symmetry::plane_strain, 163.156e6 / (1717.0 * 0.56)}};
  for (const auto& [symmetry, expected] : shells) {
    scene::Scene projectile = shell(5e-3);
    projectile.symmetry = symmetry;
    projectile.frame = scene::Frame::lab;
    projectile.load = ramp(496e6, 2e-5);
    mpm::Simulation simulation(projectile);
    run_to(simulation, 2e-5);
    const double before = simulation.axial_momentum();
    run_to(simulation, 6e-5);
    const double acceleration = (before - simulation.axial_momentum()) / (4e-5 * total_mass(simulation));
    EXPECT_NEAR(acceleration / expected, 1.0, 4e-6);
  }
}

/// The shell under a pulse of 0.2 ms, two transits of its sound, to 0.4 ms: its largest imbalance of energy
/// over the largest energy in it.
double energy_imbalance(scene::Scene shell) {
  shell.load.base = 0.0;
  shell.load.peak = 100e6;
  shell.load.shape = scene::LoadShape::power_exponential;
  shell.load.peak_time = 2e-4;
  mpm::Simulation simulation(shell);
  const double end = 4e-4, steps = std::ceil(end / simulation.stable_time_step());
  double largest = 0.0, scale = 0.0;
  for (double step = 0.0; step < steps; step += 1.0) {
    simulation.step(end / steps);
    const mpm::EnergyTotals& e = simulation.energy();
    const double stored = e.kinetic + e.internal;
    largest = std::max(largest, std::abs(stored + e.damping - e.external - e.body_force));
    scale = std::max(scale, stored);
  }
  return largest / scale;
}

TEST_P(Launches, KeepTheEnergyOfAPulse) {
  EXPECT_LT(energy_imbalance(shell(5e-3)), on_lattice() ? 1e-6 : 1e-3);
  if (on_lattice()) return;
  // Steel throughout, so that the waves stay smooth: what is left is what the particles' velocities lose on
  // the grid, 1/2 (sum m_i dv_i^2 - sum m_p dv_p^2) a step, of first order in the step over a given time.
  scene::Scene steel = shell(10e-3);
  for (scene::Body& body : steel.bodies) body.material = "steel";
  const auto imbalance = [&](double factor) {
    steel.numerics.time_step_factor = factor;
    return energy_imbalance(steel);
  };
  EXPECT_NEAR(std::log(imbalance(0.2) / imbalance(0.05)) / std::log(4.0), 1.0, 0.1);
}

/// Mean axial compression of the charge's last column, Pa.
double bottom_pressure(const mpm::Simulation& simulation) {
  const mpm::Body<materials::Charge>& charge = simulation.bodies_of<materials::Charge>()[0];
  const mpm::Lattice& lattice = charge.particles.lattice;
  double force = 0.0, area = 0.0;
  for (int j = 0; j < lattice.rows(); ++j) {
    force -= lattice.r_of(j) * axial_stress(charge, lattice.slot(lattice.columns() - 1, j));
    area += lattice.r_of(j);
  }
  return force / area;
}

TEST_P(Launches, AreTheSameInBothFrames) {
  // On the lattice at rest frames differ by round-off. The grid's charge bottom lies on a line at rest and
  // inside a cell in flight: at 2 MPa after 0.04 mm of travel, at 200 MPa after 4 mm, 0.8 of a cell.
  const struct { double pressure, on_grid; } loads[] = {{2e6, 1e-3}, {200e6, 0.03}};
  for (const auto& [pressure, on_grid] : loads) {
    scene::Scene launched = shell(5e-3);
    launched.load = ramp(pressure, 2e-4);
    mpm::Simulation co_moving(launched);
    launched.frame = scene::Frame::lab;
    mpm::Simulation lab(launched);
    double difference = 0.0, scale = 0.0;
    for (int k = 1; k <= 20; ++k) {
      run_to(co_moving, k * 2e-5);
      run_to(lab, k * 2e-5);
      difference = std::max(difference, std::abs(bottom_pressure(lab) - bottom_pressure(co_moving)));
      scale = std::max(scale, std::abs(bottom_pressure(co_moving)));
    }
    EXPECT_LT(difference / scale, on_lattice() ? 1e-8 : on_grid) << pressure;
  }
}

TEST(FreeFlight, ChangesNothing) {
  // 1 m through 378 cells at 500 m/s: a uniform stress in balance does nothing. In the total-Lagrangian form
  // no particle leaves its cell.
  const FlightDrift drift = drift_in_flight(2.7e-3, 1.0);
  EXPECT_NEAR(drift.momentum, 0.0, 1e-12);
  EXPECT_NEAR(drift.kinetic, 0.0, 1e-12);
  EXPECT_NEAR(drift.stress, 0.0, 1e-10);
  EXPECT_NEAR(drift.work, 0.0, 1e-12);
}

}  // namespace
