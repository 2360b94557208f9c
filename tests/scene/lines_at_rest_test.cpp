#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

Scene shipped_scene() {
  auto file = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
  EXPECT_TRUE(file);
  return file->scene;
}

TEST(LinesAtRest, OfTheEvenGridCoverTheShellFromTheChargeBottom) {
  Scene scene = shipped_scene();
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
