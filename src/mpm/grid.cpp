#include "launchsafe/mpm/grid.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::mpm {

Grid make_grid(const scene::Scene& scene) {
  const scene::Mesh mesh = scene::fit_mesh(scene);
  const scene::Extent extent = scene::extent_of(scene);
  Grid grid;
  grid.dx = mesh.dx;
  grid.dr = mesh.dr;
  const int cells_before = static_cast<int>(std::ceil((mesh.x_anchor - extent.x_begin) / mesh.dx - 1e-9));
  const int cells_after = static_cast<int>(std::ceil((extent.x_end - mesh.x_anchor) / mesh.dx - 1e-9));
  grid.origin_x = mesh.x_anchor - (cells_before + Grid::axial_padding) * mesh.dx;
  grid.nodes_x = cells_before + cells_after + 2 * Grid::axial_padding + 1;
  const int cells_r = static_cast<int>(std::lround(mesh.radius / mesh.dr));
  const int room = scene.barrel == scene::Barrel::none ? cells_r / 2 + 4 : 4;
  const int barrel_row = cells_r + Grid::radial_padding;
  grid.nodes_r = cells_r + 1 + Grid::radial_padding + room;
  const std::size_t whole_packs = (grid.nodes() + math::pack_width - 1) / math::pack_width * math::pack_width;
  for (auto* field :
       {&grid.mass, &grid.momentum_x, &grid.momentum_r, &grid.force_x, &grid.force_r, &grid.velocity_x,
        &grid.velocity_r, &grid.velocity_increment_x, &grid.velocity_increment_r, &grid.radially_free})
    field->assign(whole_packs, 0.0);
  for (int j = Grid::radial_padding + 1; j < grid.nodes_r; ++j)
    if (scene.barrel == scene::Barrel::none || j < barrel_row)
      std::fill_n(grid.radially_free.begin() + static_cast<std::ptrdiff_t>(grid.index(0, j)), grid.nodes_x,
                  1.0);
  return grid;
}

}  // namespace launchsafe::mpm
