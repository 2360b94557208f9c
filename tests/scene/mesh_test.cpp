#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

TEST(Mesh, ChargeAndRadiusAreWholeNumbersOfCells) {
  auto file = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
  for (const double size : {1e-3, 1.25e-3, 2.5e-3, 2.7e-3, 5e-3}) {
    file.scene.numerics.cell_size = size;
    const Mesh mesh = fit_mesh(file.scene);
    EXPECT_LE(mesh.dx, size * (1 + 1e-8));
    EXPECT_LE(mesh.dr, size * (1 + 1e-8));
    EXPECT_NEAR(0.56 / mesh.dx, std::round(0.56 / mesh.dx), 1e-9);
    EXPECT_NEAR(0.0775 / mesh.dr, std::round(0.0775 / mesh.dr), 1e-9);
    EXPECT_EQ(mesh.x_anchor, 0.678);
    EXPECT_EQ(mesh.radius, 0.0775);
  }
}

TEST(Mesh, CountsAreWholeUpToABoundThatNoComputationReaches) {
  EXPECT_EQ(counted(0.0), 0);
  EXPECT_EQ(counted(12345678901.0), 12345678901);
  for (const double many : {1e15, 1e19, 1e300, HUGE_VAL, std::nan("")})
    EXPECT_EQ(counted(many), most_counted) << many;
}

TEST(Mesh, DivisibleLengthsAreNotRoundedUp) {
  EXPECT_EQ(parts_of(0.56, 0.0025), 224);
  EXPECT_EQ(parts_of(0.3, 0.1), 3);
  EXPECT_EQ(parts_of(0.31, 0.1), 4);
  EXPECT_EQ(parts_of(0.01, 0.1), 1);
}

TEST(Mesh, EveryBodyHasAtLeastOneParticle) {
  Scene scene;
  scene.numerics.cell_size = 0.01;
  for (const Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    scene.numerics.formulation = formulation;
    scene.bodies = {{"foil", "steel", 0.0, 0.1, 0.019, 0.02}};
    scene.numerics.particles_per_cell = 1;
    EXPECT_EQ(particles_of(scene, scene.bodies[0]).nr, 1);
    EXPECT_EQ(particles_of(scene, scene.bodies[0]).nx, 10);
    scene.numerics.particles_per_cell = 2;
    EXPECT_EQ(particles_of(scene, scene.bodies[0]).nx, 20);
  }
}

TEST(Mesh, SceneWithoutChargeIsFittedAsAWhole) {
  Scene scene;
  scene.bodies = {{"bar", "steel", 0.0, 0.1, 0.0, 0.01}};
  scene.numerics.cell_size = 0.003;
  const Mesh mesh = fit_mesh(scene);
  EXPECT_DOUBLE_EQ(mesh.dx, 0.1 / 34);
  EXPECT_EQ(mesh.x_anchor, 0.1);
  EXPECT_EQ(particle_count(scene), 34 * 4);
}

TEST(Mesh, NamesTheChargeEdgeThatTheGridLinesMiss) {
  Scene scene;
  scene.numerics.formulation = Formulation::updated_lagrangian;  // the other grid runs along all edges
  scene.bodies = {{"charge", "charge", 0.0, 0.1, 0.0, 0.065}, {"wall", "steel", 0.0, 0.1, 0.065, 0.0775}};
  scene.numerics.cell_size = 2.5e-3;  // 26 and 31 cells
  EXPECT_EQ(charge_edges_off_grid(scene), "");
  scene.numerics.cell_size = 1e-3;  // 77.5 mm make 78 cells, 65 mm 65.42
  EXPECT_NE(charge_edges_off_grid(scene).find("65.42"), std::string::npos);
}

TEST(LinesAtRest, OfTheEvenGridCoverTheShellFromTheChargeBottom) {
  Scene scene = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").scene;
  EXPECT_EQ(lines_at_rest(scene).x, grid_lines(scene).x);
  scene.numerics.formulation = Formulation::updated_lagrangian;
  const GridLines lines = lines_at_rest(scene);
  const Mesh mesh = fit_mesh(scene);
  for (std::size_t i = 0; i < lines.x.size(); ++i) {
    const double cells = (lines.x[i] - mesh.x_anchor) / mesh.dx;
    EXPECT_NEAR(cells, std::round(cells), 1e-9);
  }
  EXPECT_LE(lines.x.front(), 0.0);
  EXPECT_GT(lines.x[1], 0.0);
  EXPECT_GE(lines.x.back(), 0.74);
  EXPECT_LT(lines.x[lines.x.size() - 2], 0.74);
  EXPECT_EQ(lines.r.front(), 0.0);
  EXPECT_EQ(lines.r.back(), 0.0775);
}

}  // namespace
}  // namespace launchsafe::scene
