// The total-Lagrangian form: balance on lattices of several bodies, ties, energies.
#include "launchsafe/mpm/simulation.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

using namespace launchsafe;

/// The shell on a coarse graded lattice, under a load that is over within a millisecond.
scene::Scene quick_shell() {
  scene::Scene shell = test_support::shell_155(5e-3);
  shell.numerics.growth_x = 1.3;
  shell.numerics.growth_r = 1.2;
  shell.load.duration = 2e-3;
  shell.load.shape = scene::LoadShape::power_exponential;
  shell.load.peak_time = 1e-3;
  return shell;
}

void run_until(mpm::Simulation& simulation, double end) {
  while (simulation.time() < end) simulation.step(simulation.stable_time_step());
}

/// A bar of three bodies whose edges no even grid meets.
scene::Scene bar_of_three() {
  scene::Scene bar = test_support::steel_bar(0.2, 0.02, 4e-3);
  bar.bodies = {{"front", "steel", 0.0, 0.0883, 0.0, 0.02},
                {"core", "steel", 0.0883, 0.2, 0.0, 0.0131},
                {"wall", "steel", 0.0883, 0.2, 0.0131, 0.02}};
  bar.steel().strength.a = 1e15;
  return bar;
}

TEST(TotalLagrangian, AccelerationMakesAStressThatGrowsLinearlyFromTheNose) {
  // Statics in the accelerated frame: the force on a section carries the mass before it, P_xX = -p X/L.
  // Linear elements have one axial stress a cell, that of its middle. Inertia that only lengthens steps has
  // no weight.
  for (const auto& [per_cell, selective] : {std::pair{1, 1.0}, {2, 1.0}, {1, 3.0}, {2, 3.0}}) {
    scene::Scene bar = bar_of_three();
    bar.numerics.particles_per_cell = per_cell;
    bar.numerics.selective_inertia = selective;
    bar.numerics.damping_time = 2e-5;
    bar.load = test_support::steady_pressure(100e6);
    mpm::Simulation simulation(bar);
    run_until(simulation, 8e-4 * selective);
    for (const mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>()) {
      const mpm::Lattice& lattice = body.particles.lattice;
      for (int j = 0; j < lattice.rows(); ++j)
        for (int i = 0; i < lattice.columns(); ++i) {
          const std::size_t slot = lattice.slot(i, j);
          const double stress = body.deviator(slot).xx - body.particles.pressure[slot];
          const auto cell = static_cast<std::size_t>(i / per_cell * per_cell);
          const double middle =
              0.5 * (lattice.x_edges[cell] + lattice.x_edges[cell + static_cast<std::size_t>(per_cell)]);
          EXPECT_NEAR(stress / 100e6, -middle / 0.2, 2e-6) << per_cell << ' ' << i;
        }
    }
  }
}

TEST(TotalLagrangian, ClosesItsEnergyBalance) {
  for (const int per_cell : {1, 2}) {
    scene::Scene shell = quick_shell();
    shell.numerics.particles_per_cell = per_cell;
    mpm::Simulation simulation(shell);
    double largest = 0.0, scale = 0.0;
    while (simulation.time() < 2e-3) {
      simulation.step(simulation.stable_time_step());
      const mpm::EnergyBalance& e = simulation.energy();
      largest = std::max(largest, std::abs(e.kinetic + e.internal + e.damping - e.external - e.body_force));
      scale = std::max(scale, e.kinetic + e.internal);
    }
    // What is left is the third power of a step's strain.
    EXPECT_LT(largest / scale, 1e-7) << per_cell;
    EXPECT_GT(scale, 100.0);
  }
}

TEST(TotalLagrangian, TiedNodesMoveAlike) {
  // What a tie gives its members sums to nothing; where they move alike it does no work either.
  mpm::Simulation simulation(quick_shell());
  run_until(simulation, 1e-3);
  const mpm::TotalLagrangian& form = *simulation.total_lagrangian();
  ASSERT_GT(form.ties().size(), 50u);
  double largest = 0.0;
  for (const mpm::Tie& tie : form.ties())
    for (const auto& member : tie.members) {
      const auto& first = tie.members.front();
      const mpm::Nodes &a = form.nodes()[first.nodes], &b = form.nodes()[member.nodes];
      EXPECT_EQ(a.velocity_x[first.index], b.velocity_x[member.index]);
      EXPECT_EQ(a.velocity_r[first.index], b.velocity_r[member.index]);
      largest = std::max(largest, std::abs(b.velocity_r[member.index]));
    }
  EXPECT_GT(largest, 1e-6);
}

TEST(TotalLagrangian, ABodyCutInTwoIsTheSameBody) {
  const auto pressure = [](bool cut) {
    scene::Scene bar = test_support::steel_bar(0.1, 0.02, 4e-3);
    if (cut) bar.bodies = {{"core", "steel", 0.0, 0.1, 0.0, 0.012}, {"skin", "steel", 0.0, 0.1, 0.012, 0.02}};
    bar.load = test_support::steady_pressure(500e6);
    bar.barrel = scene::Barrel::none;
    mpm::Simulation simulation(bar);
    run_until(simulation, 1e-4);
    const mpm::ParticleFields& p = mpm::particle_fields_of(simulation.bodies()[0]);
    std::vector<double> first_rows;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < p.lattice.columns(); ++i) first_rows.push_back(p.pressure[p.lattice.slot(i, j)]);
    return first_rows;
  };
  const std::vector<double> whole = pressure(false), cut = pressure(true);
  ASSERT_EQ(whole.size(), cut.size());
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(whole[i], cut[i], 1e-9 * 500e6);
}

TEST(TotalLagrangian, CountsInvertedCells) {
  // Two ends that fly into each other at several times the speed of sound.
  scene::Scene bar = test_support::steel_bar(0.05, 0.02, 4e-3);
  bar.load = test_support::steady_pressure(0.0);
  mpm::Simulation simulation(bar);
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>())
    for (std::size_t i = 0; i < body.particles.mass.size(); ++i)
      body.particles.velocity_x[i] = body.particles.x[i] < 0.025 ? 3e4 : -3e4;
  simulation.reset_grid();
  const double dt = simulation.stable_time_step();
  for (int step = 0; step < 20; ++step) simulation.step(dt);
  EXPECT_GT(simulation.events().distorted, 0.0);
}

TEST(TotalLagrangian, AStiffHourglassStoresLessBendingThanASoftOne) {
  // The energy of the mode is what is stored against it; it is part of the internal energy.
  const auto stored = [](double stiffness) {
    scene::Scene shell = quick_shell();
    shell.numerics.hourglass_stiffness = stiffness;
    mpm::Simulation simulation(shell);
    run_until(simulation, 1e-3);
    return simulation.energy();
  };
  const mpm::EnergyBalance none = stored(0.0), some = stored(0.1);
  EXPECT_EQ(none.hourglass, 0.0);
  EXPECT_GT(some.hourglass, 0.0);
  EXPECT_LT(some.hourglass, 1e-2 * some.internal);
}

/// Cells of 4 mm at the bottom that grow to 10 mm.
scene::Scene graded_shell() {
  scene::Scene shell = quick_shell();
  shell.numerics.cell_size = 4e-3;
  shell.numerics.growth_x = shell.numerics.growth_r = 1.3;
  return shell;
}

TEST(TotalLagrangian, SelectiveInertiaLengthensStepsAndLeavesLargeCellsAsTheyAre) {
  scene::Scene shell = graded_shell();
  const double plain = mpm::Simulation(shell).stable_time_step();
  shell.numerics.selective_inertia = 1.5;
  const mpm::Simulation simulation(shell);
  EXPECT_NEAR(simulation.stable_time_step() / plain, 1.5, 1e-9);
  double most = 1.0;
  int heavier = 0, unchanged = 0;
  for (const mpm::AnyBody& body : simulation.bodies()) {
    const mpm::ParticleFields& p = mpm::particle_fields_of(body);
    for (std::size_t slot = 0; slot < p.mass.size(); ++slot) {
      if (!(p.mass[slot] > 0.0)) continue;
      EXPECT_GE(p.inertia_x[slot], p.mass[slot]);
      EXPECT_GE(p.inertia_r[slot], p.mass[slot]);
      most = std::max(most, p.inertia_r[slot] / p.mass[slot]);
      ++(p.inertia_x[slot] > p.mass[slot] ? heavier : unchanged);
    }
  }
  // The step goes with the root of the inertia; shear adds a little to the cell that allows least.
  EXPECT_GE(most, 1.5 * 1.5);
  EXPECT_LE(most, 1.5 * 1.5 * 1.3);
  EXPECT_GT(heavier, 0);
  EXPECT_GT(unchanged, 0);
}

}  // namespace
