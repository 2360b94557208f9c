// Contact of faces that can slide: against closed solutions, and its own balance.
#include "contact_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace launchsafe;
using namespace launchsafe::test_support;

TEST(Contact, ClosesTheEnergyBalance) {
  for (const double friction : {0.0, 0.05, 0.1, 1.0})
    for (const int per_cell : {1, 2}) {
      scene::Scene shell = held_shell();
      shell.numerics.particles_per_cell = per_cell;
      shell.interfaces = {sliding("wall", friction), sliding("base", friction), sliding("nose", friction)};
      LoadedSimulation simulation(shell);
      double largest = 0.0, scale = 0.0;
      while (simulation.time() < 2e-3) {
        simulation.step(simulation.stable_time_step());
        const mpm::EnergyTotals& e = simulation.energy();
        largest = std::max(largest, std::abs(ledger(e)));
        scale = std::max(scale, e.kinetic + e.internal);
      }
      EXPECT_LT(largest / scale,
                2e-7);  // what is left is the third power of a step's strain, as without contact
      EXPECT_GE(simulation.energy().contact, 0.0);
      EXPECT_GE(simulation.energy().damping, 0.0);
      // Of a momentum to and fro of about 50 kg m/s.
      EXPECT_NEAR(simulation.axial_momentum(), 0.0, 1e-9);
    }
}

TEST(Contact, ABlockOnAnInclineSticksOrSlides) {
  // g (sin a - mu cos a) where tan a > mu, else rest.
  const double g = 1e4;
  for (const double friction : {0.0, 0.1, 0.3, 0.7})
    for (const double slope : {0.05, 0.25, 0.5}) {
      LoadedSimulation simulation(block_on_floor(sliding("", friction)));
      const double angle = std::atan(slope);
      pull_slowly(simulation, g * std::sin(angle), -g * std::cos(angle), 400);
      const double begin = simulation.time(), before = velocity_of(simulation, 1);
      while (simulation.time() < begin + 1e-3) simulation.step(simulation.stable_time_step());
      const double measured = (velocity_of(simulation, 1) - before) / (simulation.time() - begin);
      const double expected = std::max(0.0, g * (std::sin(angle) - friction * std::cos(angle)));
      EXPECT_NEAR(measured, expected, 2e-4 * g) << friction << ' ' << slope;
    }
}

TEST(Contact, UniformPressurePassesASlippedInterface) {
  // The block is drawn over the floor, across several of its graded cells.
  scene::Scene scene = block_on_floor(sliding("", 0.0));
  scene.numerics.damping_time = 2e-5;
  scene.numerics.growth_x = 1.2;
  scene.numerics.refined_x = {0.03};
  scene.numerics.largest_cell = 5e-3;
  LoadedSimulation simulation(scene);
  const double pressure = 1e5 * block_density * block_height;
  pull_slowly(simulation, 1e5, -1e5, 400);
  double worst = 0.0;
  const auto moved = [&] {
    const mpm::ParticleFields& p = mpm::particle_fields_of(simulation.bodies()[1]);
    return p.x[0] - p.lattice.x_of(0);
  };
  while (moved() < 8e-3) {
    simulation.step(simulation.stable_time_step());
    if (moved() < 1e-3) continue;
    for (const mpm::FaceState& node : simulation.total_lagrangian()->contact().state_of(0))
      worst = std::max(worst, std::abs(node.pressure / pressure - 1.0));
  }
  EXPECT_LT(worst, 2e-4);  // ripple of the block, whose force is turned on in 400 steps
}

TEST(Contact, ABouncingBlockGainsNoEnergy) {
  // Thrown up askew and drawn back, it falls on one edge, tilts, slides and bounces.
  LoadedSimulation simulation(block_on_floor(sliding("", 0.3)));
  simulation.apply_body_force(1, 0.0, -1e4);
  std::visit(
      [](auto& body) {
        mpm::ParticleFields& block = body.particles;
        for (std::size_t i = 0; i < block.mass.size(); ++i) {
          if (!(block.mass[i] > 0.0)) continue;
          block.velocity_r[i] = 0.3 + 2.0 * (block.x[i] - 0.04);
          block.velocity_x[i] = 2.0;
        }
      },
      simulation.bodies()[1]);
  simulation.reset_grid();
  double drift = 0.0, initial = 0.0, deepest = 0.0;
  int parted = 0;
  bool touched = true;
  while (simulation.time() < 3e-3) {
    simulation.step(simulation.stable_time_step());
    const mpm::EnergyTotals& e = simulation.energy();
    if (initial == 0.0) initial = e.kinetic;
    drift = std::max(drift, std::abs(ledger(e) - initial) / initial);
    EXPECT_GT(e.contact, -1e-9 * initial);
    bool touches = false;
    for (const mpm::FaceState& node : simulation.total_lagrangian()->contact().state_of(0)) {
      touches = touches || node.pressure > 0.0;
      deepest = std::min(deepest, node.gap);
    }
    parted += touched && !touches ? 1 : 0;
    touched = touches;
  }
  EXPECT_GE(parted, 2);
  EXPECT_GT(deepest, -1e-9);  // m, of flights of some micrometres
  EXPECT_LT(drift, 1e-5);     // the second power of strains of some 1e-4
}

TEST(Contact, ABarIsHeldBackInASleeveByFrictionTimesItsGrip) {
  // The sleeve is pressed on the bar by its own body force: p = rho t a. It is shorter than the bar, whose
  // nodes come in at one end and leave at the other.
  scene::Scene scene;
  scene.symmetry = scene::Symmetry::plane_strain;
  scene.barrel = scene::Barrel::none;
  scene.load = steady_pressure(0.0);
  scene.materials = {plain("bar", 1e9, 0.0, 2000.0), plain("sleeve", 1e11, 0.0, 8000.0)};
  scene.bodies = {{"bar", "bar", 0.0, 0.2, 0.0, 0.01}, {"sleeve", "sleeve", 0.08, 0.12, 0.01, 0.02}};
  scene.interfaces = {sliding("sleeve", 0.3)};
  scene.interfaces[0].against = "bar";
  LoadedSimulation simulation(scene);
  const double grip = 8000.0 * 0.01 * 1e4 * 0.04, friction = 0.3 * grip, mass = 2000.0 * 0.2 * 0.01;
  for (int step = 0; step < 400; ++step) {
    simulation.apply_body_force(0, 5e3 / 400, 0.0);
    simulation.apply_body_force(1, -friction / (8000.0 * 0.01 * 0.04) / 400, -1e4 / 400);
    simulation.step(simulation.stable_time_step());
  }
  const auto inward = [&] {
    const mpm::ParticleFields& p = mpm::particle_fields_of(simulation.bodies()[1]);
    return -std::inner_product(p.mass.begin(), p.mass.end(), p.velocity_r.begin(), 0.0);
  };
  const double begin = simulation.time(), before = velocity_of(simulation, 0), inward_before = inward();
  double given = 0.0;
  while (simulation.time() < begin + 2.5e-3) {
    const double dt = simulation.stable_time_step();
    simulation.step(dt);
    given += dt * normal_force(simulation.total_lagrangian()->contact().state_of(0));
  }
  const double time = simulation.time() - begin;
  const double gained = velocity_of(simulation, 0) - before;
  const mpm::ParticleFields& bar = mpm::particle_fields_of(simulation.bodies()[0]);
  // The sleeve's edges press dents into the bar, so that pressure is not quite across.
  EXPECT_NEAR(gained / time, 5e3 - 0.3 * given / time / mass, 2e-4 * 5e3);
  EXPECT_NEAR(given, grip * time - (inward() - inward_before), 1e-3 * grip * time);
  EXPECT_GT(bar.x[0] - bar.lattice.x_of(0), 5e-3);
}

/// A column of a charge (body 1) of Poisson's ratio 0.25 in a stiff tube under the setback that presses with
/// `whole` (Pa) on its bottom without friction.
scene::Scene column_in_tube(double friction, double whole) {
  scene::Scene scene;
  scene.materials = {plain("stiff", 1e12, 0.25, 1e5), plain("soft", 2e9, 0.25, 1700.0)};
  scene.bodies = {{"tube", "stiff", 0.0, 0.1, 0.02, 0.03},
                  {"column", "soft", 0.0, 0.1, 0.0, 0.02},
                  {"base", "stiff", 0.1, 0.12, 0.0, 0.03}};
  for (const char* body : {"tube", "base"}) {
    scene.interfaces.push_back(sliding(body, body[0] == 'b' ? 0.0 : friction));
    scene.interfaces.back().against = "column";
  }
  scene.numerics.cell_size = 2e-3;
  scene.numerics.damping_time = 5e-5;
  const double pressure = whole / (1700.0 * 0.1) * scene::total_mass(scene) / scene::base_area(scene);
  scene.load = steady_pressure(pressure);
  scene.load.curve_time = {0.0, 1.5e-3, 1.0};
  scene.load.curve_pressure = {0.0, pressure, pressure};
  return scene;
}

/// Force on the column's bottom and along its side, over that of the whole column without friction.
std::pair<double, double> bottom_and_side(double friction) {
  const double whole = 1e6, area = 0.5 * 0.02 * 0.02;
  LoadedSimulation simulation(column_in_tube(friction, whole));
  go_until(simulation, 2.5e-3);
  const mpm::Contact& contact = simulation.total_lagrangian()->contact();
  std::pair<double, double> shares;
  for (std::size_t f = 0; f < contact.faces(); ++f) {
    const auto nodes = contact.state_of(f);
    if (simulation.scene().interfaces[contact.interface_of(f)].body == "base") {
      shares.first = normal_force(nodes) / (whole * area);
    } else {
      for (const mpm::FaceState& node : nodes) shares.second += node.shear * node.area / (whole * area);
    }
  }
  return shares;
}

TEST(Contact, AColumnWithoutFrictionStandsOnItsBottomAlone) {
  // rho L a.
  const auto [bottom, side] = bottom_and_side(0.0);
  EXPECT_NEAR(bottom, 1.0, 1e-5);
  EXPECT_EQ(side, 0.0);
}

TEST(Contact, FrictionCarriesAColumnInATubeAsInASilo) {
  // Janssen 1895 with the elastic ratio of pressures k = nu/(1 - nu): the mean axial stress at depth z under
  // the free top is rho a R/(2 mu k) (1 - exp(-2 mu k z/R)). It takes plane sections; shear bends them, by
  // more the larger the friction, and sticking begins near the bottom.
  for (const auto& [friction, allowed] : {std::pair{0.05, 0.004}, {0.1, 0.004}, {0.2, 0.004}, {0.4, 0.04}}) {
    const auto [bottom, side] = bottom_and_side(friction);
    const double depth = 2.0 * friction * (0.25 / 0.75) * 0.1 / 0.02;
    EXPECT_NEAR(bottom, (1.0 - std::exp(-depth)) / depth, allowed) << friction;
    EXPECT_NEAR(bottom + side, 1.0, 1e-4) << friction;
  }
}

TEST(Contact, NoNumberOfThreadsChangesABitOfSliding) {
  const auto run = [](int threads) {
    scene::Scene shell = held_shell();
    shell.interfaces = {sliding("wall", 0.1), sliding("base", 0.1), sliding("nose", 0.1)};
    LoadedSimulation simulation(shell, threads);
    for (int step = 0; step < 300; ++step) simulation.step(simulation.stable_time_step());
    math::AlignedArray all = mpm::particle_fields_of(simulation.bodies()[1]).velocity_r;
    all.push_back(simulation.energy().contact);
    all.push_back(simulation.energy().kinetic);
    return all;
  };
  const math::AlignedArray alone = run(1);
  for (const int threads : {2, 3, 7}) EXPECT_EQ(run(threads), alone) << threads;
}

}  // namespace
