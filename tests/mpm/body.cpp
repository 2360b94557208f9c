// Particles tile their bodies exactly, whatever the grid.
#include "launchsafe/mpm/body.hpp"

#include "launchsafe/mpm/simulation.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <set>

namespace {

using namespace launchsafe;

double mass_of_material(const mpm::Simulation& simulation, const std::string& material) {
  double total = 0.0;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    if (simulation.scene().bodies[static_cast<std::size_t>(p.body)].material == material)
      total += mpm::mass_of(p);
  });
  return total;
}

TEST(Particles, HaveTheMassOfTheFormulaOnEveryMesh) {
  // Cylinders: steel = 7830 pi [0.0775^2 0.74 - 0.065^2 0.56] kg, charge = 1717 pi 0.065^2 0.56 kg.
  const double charge = 1717.0 * std::numbers::pi * 0.065 * 0.065 * 0.56;
  const double steel = 7830.0 * std::numbers::pi * (0.0775 * 0.0775 * 0.74 - 0.065 * 0.065 * 0.56);
  EXPECT_NEAR(charge, 12.7625, 5e-5);
  EXPECT_NEAR(steel, 51.1314, 5e-5);
  for (const double cell : {1.5e-3, 2.5e-3, 3.1e-3, 5e-3, 7e-3, 0.0123, 0.04, 0.5})
    for (const int per_cell : {1, 2, 3}) {
      const mpm::Simulation simulation(test_support::shell_155(cell, per_cell));
      EXPECT_NEAR(mass_of_material(simulation, "charge"), charge, 1e-12 * charge) << cell;
      EXPECT_NEAR(mass_of_material(simulation, "steel"), steel, 1e-12 * steel) << cell;
    }
}

TEST(Lattice, GivesEveryParticleItsOwnSlotAndLeavesPaddingMassless) {
  for (const int per_cell : {1, 2, 3}) {
    const scene::Scene shell = test_support::shell_155(7e-3, per_cell);
    const auto charge = std::get<mpm::Body<materials::Charge>>(mpm::make_body(shell, 1));
    const mpm::Lattice& lattice = charge.particles.lattice;
    std::set<std::size_t> slots;
    for (int j = 0; j < lattice.rows(); ++j)
      for (int i = 0; i < lattice.columns(); ++i) {
        const std::size_t slot = lattice.slot(i, j);
        EXPECT_TRUE(slots.insert(slot).second);
        EXPECT_DOUBLE_EQ(charge.particles.x[slot], lattice.x_of(i));
        EXPECT_DOUBLE_EQ(charge.particles.r[slot], lattice.r_of(j));
      }
    for (std::size_t slot = 0; slot < lattice.slots(); ++slot)
      EXPECT_EQ(charge.particles.mass[slot] > 0.0, slots.contains(slot)) << slot;
  }
}

}  // namespace
