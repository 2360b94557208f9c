// Contact of faces that can slide: against closed solutions, and its own balance.
#include "contact_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
        const mpm::EnergyBalance& e = simulation.energy();
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
    const auto nodes = contact.state_of(f, simulation.total_lagrangian()->nodes());
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

}  // namespace
