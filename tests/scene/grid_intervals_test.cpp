#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace launchsafe::scene {
namespace {

using Names = std::vector<std::string>;

Scene shipped_scene() {
  auto file = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
  EXPECT_TRUE(file);
  return file->scene;
}

void expect_whole(const std::vector<GridInterval>& intervals, const std::vector<double>& lines) {
  std::size_t line = 0;
  for (const GridInterval& each : intervals) {
    EXPECT_EQ(each.from, lines[line]);
    line += static_cast<std::size_t>(each.cells);
    ASSERT_LT(line, lines.size());
    EXPECT_EQ(each.to, lines[line]);
    EXPECT_LE(each.shortest, (each.to - each.from) / each.cells * (1 + 1e-9));
    EXPECT_GE(each.longest, (each.to - each.from) / each.cells * (1 - 1e-9));
  }
  EXPECT_EQ(line + 1, lines.size());
}

TEST(GridIntervals, TogetherAreTheWholeGridOfEitherForm) {
  Scene scene = shipped_scene();
  for (const Formulation formulation : {Formulation::total_lagrangian, Formulation::updated_lagrangian}) {
    scene.numerics.formulation = formulation;
    for (const double size : {2.5e-3, 0.9e-3}) {
      scene.numerics.cell_size = size;
      const GridIntervals intervals = grid_intervals(scene);
      const GridLines lines = lines_at_rest(scene);
      expect_whole(intervals.x, lines.x);
      expect_whole(intervals.r, lines.r);
      const CellRange cells = cells_of(scene);
      EXPECT_EQ(cells.nx + 1, static_cast<int>(lines.x.size()));
      EXPECT_EQ(cells.nr + 1, static_cast<int>(lines.r.size()));
    }
  }
}

TEST(GridIntervals, EndAtEdgesOfBodiesAndNameThem) {
  const Scene scene = shipped_scene();
  const GridIntervals intervals = grid_intervals(scene);
  ASSERT_EQ(intervals.x.size(), 3u);
  ASSERT_EQ(intervals.r.size(), 2u);
  EXPECT_EQ(intervals.x[1].from, 0.118);
  EXPECT_EQ(intervals.x[1].to, 0.678);
  EXPECT_EQ(intervals.x[1].cells, cells_of(scene, scene.bodies[1]).nx);
  EXPECT_EQ(intervals.x[0].edge_before, Names{"nose"});
  EXPECT_EQ(intervals.x[1].edge_before, (Names{"nose", "charge", "wall"}));
  EXPECT_EQ(intervals.x[1].edge_behind, (Names{"charge", "wall", "base"}));
  EXPECT_EQ(intervals.r[1].edge_behind, (Names{"nose", "wall", "base"}));
  EXPECT_LT(intervals.x[1].shortest, 0.5 * intervals.x[1].longest) << "cells grow away from the bottom";
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
