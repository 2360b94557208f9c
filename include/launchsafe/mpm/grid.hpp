// The background grid: a regular lattice of nodes, x fastest, rebuilt every step.
#pragma once

#include "launchsafe/math/aligned_array.hpp"
#include "launchsafe/scene/mesh.hpp"

namespace launchsafe::mpm {

/// Node (i, j) lies at x = origin_x + i dx, r = (j - radial_padding) dr. Masses and forces are per radian
/// (axisymmetric) or per metre of depth (plane strain).
struct Grid {
  static constexpr int axial_padding = 12;  ///< cells beyond the shell: a Pack may read past a body's end
  static constexpr int radial_padding = 1;

  int nodes_x = 0, nodes_r = 0;
  double dx = 0, dr = 0;             ///< m
  double origin_x = 0;               ///< m; moves by whole cells with the co-moving grid
  math::AlignedArray radially_free;  ///< 1 where v_r is free, 0 on the axis and at the barrel

  // Sums over the particles, from the last step on.
  math::AlignedArray mass;                    ///< kg
  math::AlignedArray momentum_x, momentum_r;  ///< kg m/s
  math::AlignedArray force_x, force_r;        ///< N, internal
  // Nodal results of the step, interpolated to the particles.
  math::AlignedArray velocity_x, velocity_r;                      ///< m/s, at the end of the step
  math::AlignedArray velocity_increment_x, velocity_increment_r;  ///< m/s, over the step

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_x) + static_cast<std::size_t>(i);
  }
  std::size_t nodes() const { return static_cast<std::size_t>(nodes_x) * static_cast<std::size_t>(nodes_r); }
};

/// A grid around the scene at rest. Without a barrel it reaches to 1.5 times the shell's radius, so that
/// the shell can expand.
Grid make_grid(const scene::Scene& scene);

}  // namespace launchsafe::mpm
