// Energy of the assembled projectile, in either formulation.
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
    const mpm::EnergyBalance& e = simulation.energy();
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

}  // namespace
