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
  double dx = 0, dr = 0;       ///< m
  double origin_x = 0;         ///< m; moves by whole cells with the window
  math::AlignedArray moves_r;  ///< 1 where v_r is free, 0 on the axis and at the barrel

  // What the particles add up in a step.
  math::AlignedArray mass;                    ///< kg
  math::AlignedArray momentum_x, momentum_r;  ///< kg m/s
  math::AlignedArray force_x, force_r;        ///< N, internal
  // What the particles read in the next.
  math::AlignedArray velocity_x, velocity_r;  ///< m/s, at the end of the step
  math::AlignedArray change_x, change_r;      ///< m/s, gained in the step

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_x) + static_cast<std::size_t>(i);
  }
  std::size_t nodes() const { return static_cast<std::size_t>(nodes_x) * static_cast<std::size_t>(nodes_r); }
};

/// A grid around the scene at rest. Without a barrel it has room for the shell to swell to 1.5 times its
/// radius.
Grid make_grid(const scene::Scene& scene);

}  // namespace launchsafe::mpm
