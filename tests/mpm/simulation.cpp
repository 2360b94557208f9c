// The step: balance of uniform stress, momentum.
#include "launchsafe/mpm/simulation.hpp"

#include "exact_solutions.hpp"
#include "loads.hpp"
#include "scenes.hpp"
#include "support/mie_gruneisen_pressure.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe;

/// Scenes whose meshes do and do not divide their lengths, on the even background grid.
std::vector<scene::Scene> patches() {
  std::vector<scene::Scene> all;
  for (const double cell : {2.5e-3, 2.7e-3})
    for (const int per_cell : {1, 2, 3}) {
      scene::Scene bar = test_support::steel_bar(0.06, 0.02, cell, per_cell);
      // Two bodies whose common face lies inside cells.
      bar.bodies = {{"front", "steel", 0.0, 0.0283, 0.0, 0.02},
                    {"core", "steel", 0.0283, 0.06, 0.0, 0.0131},
                    {"wall", "steel", 0.0283, 0.06, 0.0131, 0.02}};
      bar.numerics.formulation = scene::Formulation::updated_lagrangian;
      all.push_back(bar);
    }
  return all;
}

TEST(PatchTest, PressureOnTheBaseBalancesUniformStress) {
  for (const scene::Scene& bar : patches()) {
    const double mu = 1e-3;
    scene::Scene loaded = bar;
    const double pressure = test_support::mie_gruneisen_pressure(bar.steel().eos, mu, 0.0);
    loaded.load = test_support::steady_pressure(pressure);
    // What the frame gives to every node that carries mass.
    const double acceleration = scene::rigid_acceleration(loaded, pressure);
    mpm::Simulation simulation(loaded);
    test_support::compress(simulation, mu);
    const double dt = 1e-12;
    simulation.step(dt);  // gives the grid the stress
    const mpm::Grid& grid = simulation.updated_lagrangian()->grid();
    const double largest_force = *std::max_element(grid.force_x.begin(), grid.force_x.end());
    ASSERT_GT(largest_force, 0.0);
    const math::AlignedArray force_r = grid.force_r;
    simulation.step(dt);
    for (int j = 0; j < grid.nodes_r; ++j)
      for (int i = 0; i < grid.nodes_x; ++i) {
        const std::size_t n = grid.index(i, j);
        const bool beyond_front = grid.origin_x + i * grid.dx > 2.5 * grid.dx;
        if (beyond_front && grid.velocity_increment_x[n] != 0.0) {
          EXPECT_NEAR(grid.velocity_increment_x[n] / dt, acceleration, 1e-3)
              << i << ' ' << j;  // m/s2, of 1e7 at the free front
        }
        if (grid.radially_free[n] > 0.0) {
          EXPECT_NEAR(force_r[n] / largest_force, 0.0, 1e-12) << i << ' ' << j;
        }
      }
  }
}

TEST(PatchTest, PressureInTheBoreBalancesUniformStress) {
  for (const double cell : {2.5e-3, 2.7e-3}) {
    scene::Scene tube = test_support::steel_bar(0.06, 0.02, cell);
    tube.bodies[0].r_begin = 0.0087;
    tube.numerics.formulation = scene::Formulation::updated_lagrangian;
    const double mu = 1e-3;
    tube.load =
        test_support::steady_pressure(test_support::mie_gruneisen_pressure(tube.steel().eos, mu, 0.0));
    mpm::Simulation simulation(tube);
    const double pressure = test_support::compress(simulation, mu), dt = 1e-12;
    for (int step = 0; step < 2; ++step) {
      test_support::press_bore(simulation, pressure);
      simulation.step(dt);
    }
    const mpm::Grid& grid = simulation.updated_lagrangian()->grid();
    for (int j = 0; j < grid.nodes_r; ++j)
      for (int i = 0; i < grid.nodes_x; ++i) {
        const std::size_t n = grid.index(i, j);
        if (grid.radially_free[n] > 0.0) {
          EXPECT_NEAR(grid.velocity_increment_r[n] / dt, 0.0, 1e-2) << i << ' ' << j;  // m/s2, of 1e7 without
        }
      }
  }
}

TEST(Simulation, KeepsTheRelativeMomentumZero) {
  // The body force takes exactly what the pressure gives, so the projectile stays where it is.
  scene::Scene shell = test_support::shell_155(5e-3);
  shell.load.shape = scene::LoadShape::power_exponential;
  shell.load.peak_time = 1e-3;
  shell.load.duration = 1e-3;
  mpm::Simulation simulation(shell);
  double given = 0.0;
  while (simulation.time() < 1e-3) {
    const double dt = simulation.stable_time_step();
    given += scene::rigid_acceleration(shell, simulation.chamber_pressure()) * dt;
    simulation.step(dt);
  }
  EXPECT_GT(given, 10.0);
  EXPECT_NEAR(simulation.axial_momentum() / 10.0, 0.0, 1e-10 * given);
}

/// A charge in a rigid barrel is compressed along x alone, without return: the equivalent of its deviatoric
/// strain is 2/3 of what its volume loses, and friction's heat so 2/3 mu_d of the work of the pressure, which
/// is nearly linear in the volume.
TEST(Simulation, HeatsAChargeByFrictionAsUniaxialCompressionSays) {
  for (const scene::Formulation formulation : test_support::both_formulations) {
    scene::Scene block = test_support::block("charge", 0.1, 0.02, 2.5e-3, formulation);
    block.load = test_support::ramp(50e6, 1e-3);
    mpm::Simulation simulation(block);
    test_support::run_to(simulation, 1e-3);
    const mpm::Body<materials::Charge>& charge = simulation.bodies_of<materials::Charge>()[0];
    const mpm::ParticleFields& p = charge.particles;
    double work = 0.0;
    for (std::size_t slot = 0; slot < p.mass.size(); ++slot)
      work += p.mass[slot] / charge.law.density * 0.5 * p.pressure[slot] * (1.0 - p.volume_ratio[slot]);
    const mpm::EnergyBalance& energy = simulation.energy();
    EXPECT_NEAR(energy.charge_friction / (charge.law.sliding_friction * work), 2.0 / 3.0, 0.02);
    EXPECT_NEAR(energy.charge_work / energy.internal, 1.0, 1e-3) << "there is nothing else";
    EXPECT_GT(energy.charge_work, work) << "the deviator takes work too";
  }
}

TEST(Simulation, InertialScalingLengthensTheStepByItsRoot) {
  scene::Scene shell = test_support::shell_155(5e-3);
  const double plain = mpm::Simulation(shell).stable_time_step();
  shell.numerics.inertial_scaling = 16.0;
  EXPECT_NEAR(mpm::Simulation(shell).stable_time_step(), 4.0 * plain, 1e-12 * plain);
}

TEST(Simulation, IsBitwiseRepeatable) {
  const auto run = [] {
    mpm::Simulation simulation(test_support::shell_155(5e-3));
    for (int step = 0; step < 200; ++step) simulation.step(simulation.stable_time_step());
    return simulation.bodies_of<materials::Charge>()[0].get().particles.x;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
