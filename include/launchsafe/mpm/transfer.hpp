// The background grid, and particle-to-grid and grid-to-particle transfer of a Pack of particles.
//
// Neighbouring particles mostly lie in consecutive cells, so node values are read and written as consecutive
// Packs. Lanes for which that holds with the same offset share a pass; after cell crossings a
// Pack takes two passes, in the worst case one a lane. One path, no scalar fallback, and an order of addition
// that is fixed.
#pragma once

#include "launchsafe/scene/plan.hpp"

namespace launchsafe::mpm {

using math::Mask;
using math::Pack;

// The background grid: a regular lattice of nodes, x fastest, rebuilt every step.

/// Node (i, j) lies at x = origin_x + i dx, r = (j - radial_padding) dr. Masses and forces are per radian.
struct Grid {
  static constexpr int axial_padding = 12;  ///< cells beyond the shell: a Pack may read past a body's end
  static constexpr int radial_padding = 1;

  int nodes_x = 0, nodes_r = 0;
  double dx = 0, dr = 0;             ///< m
  double origin_x = 0;               ///< m; follows the charge's bottom
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

// uGIMP shape functions of one particle on the three nodes that it can touch (Bardenhagen & Kober 2004;
// axisymmetric form of Nairn & Guilkey 2015). They are written as integrals of the hat function over the
// particle's interval, which gives the published branches (model section 2) without a branch.

/// Weights on the nodes first, first + 1, first + 2. `value` sums to 1, `gradient` (1/m) to 0.
template <class Real>
struct AxialWeights {
  Real value[3];
  Real gradient[3];
};

/// `position` (m) of the particle from the first node, in [half, cell + half]; half-length `half` <= cell/2
/// (m).
template <class Real>
AxialWeights<Real> axial_weights(Real position, double half, double cell) {
  using math::max;
  const Real xi = position * Real(1.0 / cell);
  const Real overlap =
      max(xi + Real(half / cell - 1.0), Real(0.0));  // part of the interval in the second cell
  const Real third = overlap * overlap * Real(0.25 * cell / half);
  const Real slope = overlap * Real(0.5 / half);
  return {{Real(1.0) - xi + third, xi - Real(2.0) * third, third},
          {slope - Real(1.0 / cell), Real(1.0 / cell) - Real(2.0) * slope, slope}};
}

/// As above with the weight r; `hoop` (1/m) is the mean of N/r.
template <class Real>
struct RadialWeights {
  Real value[3];
  Real gradient[3];
  Real hoop[3];
};

/// A particle's interval in r, cut at the axis: [centre - half, centre + half] with centre >= half > 0 (m).
template <class Real>
struct RadialInterval {
  Real centre;
  Real half;
};

template <class Real>
RadialInterval<Real> cut_at_axis(Real r, double half) {
  using math::select;
  const Real cut = Real(0.5) * (r + Real(half));
  const auto crosses = r < Real(half);
  return {select(crosses, cut, r), select(crosses, cut, Real(half))};
}

/// `first_node` (m) is the radius of the first node; the interval must begin in the cell after it.
template <class Real>
RadialWeights<Real> axisymmetric_weights(RadialInterval<Real> interval, Real first_node, double cell) {
  using math::max;
  const Real r = interval.centre, half = interval.half;
  const Real inverse_area = Real(0.5) / (half * r);  // 1 / integral of r dr
  const Real second_node = first_node + Real(cell);
  const Real overlap = max(r + half - second_node, Real(0.0));  // m, in the second cell
  const Real inverse_cell(1.0 / cell);
  const Real second_share = overlap * (second_node + Real(0.5) * overlap) * inverse_area;  // of integral r dr
  const Real third =
      overlap * overlap * (Real(0.5) * second_node + Real(1.0 / 3.0) * overlap) * inverse_area * inverse_cell;
  const Real xi = (r + half * half / (Real(3.0) * r) - first_node) * inverse_cell;
  const Real planar_xi = (r - first_node) * inverse_cell;
  const Real planar_third = Real(0.25) * overlap * overlap * inverse_cell / half;
  const Real inverse_r = Real(1.0) / r;
  return {{Real(1.0) - xi + third, xi - Real(2.0) * third, third},
          {(second_share - Real(1.0)) * inverse_cell, (Real(1.0) - Real(2.0) * second_share) * inverse_cell,
           second_share * inverse_cell},
          {(Real(1.0) - planar_xi + planar_third) * inverse_r,
           (planar_xi - Real(2.0) * planar_third) * inverse_r, planar_third * inverse_r}};
}

/// Constants of a body and a grid for all stencils of a step.
struct StencilContext {
  const Grid& grid;
  double origin_x;        ///< of the window, m; differs between reading and writing when the window moves
  double half_x, half_r;  ///< m
};

/// Weights of a Pack of particles, and the first node of each.
struct Stencil {
  AxialWeights<Pack> axial;
  RadialWeights<Pack> radial;
  Mask::Lanes first;  ///< node index minus lane: equal for lanes on consecutive nodes
  Mask inside;        ///< the particle lies on the grid
};

inline Pack to_pack(Mask::Lanes integers) { return Pack(__builtin_convertvector(integers, Pack::Lanes)); }
inline Mask::Lanes truncate(Pack x) { return __builtin_convertvector(x.lanes, Mask::Lanes); }

/// Splits a grid coordinate into the cell and a flag. Coordinates outside [lowest, highest) and NaN read as
/// `lowest`.
struct CellPosition {
  Mask::Lanes cell;
  Mask inside;
};
inline CellPosition locate(Pack coordinate, int lowest, int highest) {
  const Pack low(static_cast<double>(lowest));
  const Mask inside = (coordinate >= low) & (coordinate < Pack(static_cast<double>(highest)));
  return {truncate(select(inside, coordinate, low)), inside};
}

/// Stencils of a Pack of particles. It may touch `pack_width` - 1 nodes before and after those of its
/// particles, hence the margin.
inline Stencil stencil_of(const StencilContext& context, Pack x, Pack r) {
  constexpr int margin = static_cast<int>(math::pack_width);
  const Grid& grid = context.grid;
  const Pack local_x = x - context.origin_x;
  const CellPosition axial =
      locate((local_x - context.half_x) * (1.0 / grid.dx), margin, grid.nodes_x - 2 - margin);
  Stencil stencil;
  stencil.axial = axial_weights(local_x - to_pack(axial.cell) * grid.dx, context.half_x, grid.dx);
  // Radial coordinates count from the padding row below r = 0.
  const double padding = Grid::radial_padding;
  const int highest = grid.nodes_r - 3;
  const auto interval = cut_at_axis(r, context.half_r);
  const CellPosition radial =
      locate((interval.centre - interval.half) * (1.0 / grid.dr) + padding, Grid::radial_padding, highest);
  stencil.radial = axisymmetric_weights(interval, (to_pack(radial.cell) - padding) * grid.dr, grid.dr);
  stencil.first = radial.cell * static_cast<std::int64_t>(grid.nodes_x) + axial.cell - math::lane_numbers;
  stencil.inside = axial.inside & radial.inside;
  return stencil;
}

/// Calls `pass(first_node, lanes)` for every group of lanes on consecutive nodes; `lanes` are those it
/// serves.
template <class Pass>
void for_each_run(const Stencil& stencil, Mask lanes, Pass&& pass) {
  while (any(lanes)) {
    std::size_t leader = 0;
    while (lanes.lanes[leader] == 0) ++leader;
    const std::int64_t first = stencil.first[leader];
    const Mask run{lanes.lanes & (stencil.first == first)};
    pass(static_cast<std::ptrdiff_t>(first), run);
    lanes = lanes & !run;
  }
}

/// Grid-to-particle interpolation at a Pack of particles.
struct GridToParticle {
  Pack velocity_x{0.0}, velocity_r{0.0};                      ///< m/s
  Pack velocity_increment_x{0.0}, velocity_increment_r{0.0};  ///< m/s
  Pack rate_rr{0.0}, rate_xx{0.0}, rate_tt{0.0};              ///< 1/s
  Pack vr_by_x{0.0}, vx_by_r{0.0};                            ///< 1/s
};

namespace detail {

inline GridToParticle grid_to_particle_run(const Grid& grid, const Stencil& s, std::ptrdiff_t first) {
  GridToParticle g;
  for (int j = 0; j < 3; ++j) {
    Pack vx(0.0), vr(0.0), cx(0.0), cr(0.0), vx_by_x(0.0), vr_by_x(0.0);
    const std::ptrdiff_t row = first + j * static_cast<std::ptrdiff_t>(grid.nodes_x);
    for (int i = 0; i < 3; ++i) {
      const Pack node_vx = Pack::load(grid.velocity_x.data() + row + i);
      const Pack node_vr = Pack::load(grid.velocity_r.data() + row + i);
      vx += s.axial.value[i] * node_vx;
      vr += s.axial.value[i] * node_vr;
      vx_by_x += s.axial.gradient[i] * node_vx;
      vr_by_x += s.axial.gradient[i] * node_vr;
      cx += s.axial.value[i] * Pack::load(grid.velocity_increment_x.data() + row + i);
      cr += s.axial.value[i] * Pack::load(grid.velocity_increment_r.data() + row + i);
    }
    const Pack value = s.radial.value[j], gradient = s.radial.gradient[j];
    g.velocity_x += value * vx;
    g.velocity_r += value * vr;
    g.velocity_increment_x += value * cx;
    g.velocity_increment_r += value * cr;
    g.rate_rr += gradient * vr;
    g.rate_xx += value * vx_by_x;
    g.rate_tt += s.radial.hoop[j] * vr;
    g.vr_by_x += value * vr_by_x;
    g.vx_by_r += gradient * vx;
  }
  return g;
}

inline void blend(GridToParticle& into, const GridToParticle& from, Mask lanes) {
  const auto take = [lanes](Pack& a, const Pack& b) { a = select(lanes, b, a); };
  take(into.velocity_x, from.velocity_x);
  take(into.velocity_r, from.velocity_r);
  take(into.velocity_increment_x, from.velocity_increment_x);
  take(into.velocity_increment_r, from.velocity_increment_r);
  take(into.rate_rr, from.rate_rr);
  take(into.rate_xx, from.rate_xx);
  take(into.rate_tt, from.rate_tt);
  take(into.vr_by_x, from.vr_by_x);
  take(into.vx_by_r, from.vx_by_r);
}

inline void accumulate(double* target, Pack value) { (Pack::load(target) + value).store(target); }

}  // namespace detail

/// Interpolates the grid velocities and their gradients at the particles in `lanes`; the others get zeros.
inline GridToParticle grid_to_particle(const Grid& grid, const Stencil& stencil, Mask lanes) {
  GridToParticle result;
  for_each_run(stencil, lanes, [&](std::ptrdiff_t first, Mask run) {
    detail::blend(result, detail::grid_to_particle_run(grid, stencil, first), run);
  });
  return result;
}

/// Particle-to-grid contribution of a Pack of particles.
struct ParticleToGrid {
  Pack mass, velocity_x, velocity_r;                ///< kg, m/s
  Pack volume;                                      ///< m3 per radian
  Pack stress_rr, stress_xx, stress_tt, stress_rx;  ///< Cauchy, tension positive, Pa
};

/// Adds mass, momentum and internal force f = -sum V (stress grad N) (model section 2) of the lanes in
/// `lanes`.
inline void particle_to_grid(Grid& grid, const Stencil& s, const ParticleToGrid& p, Mask lanes) {
  // Local copies: the compiler cannot know that the sums do not hold the grid's own pointers.
  double* const node_mass = grid.mass.data();
  double* const momentum_x = grid.momentum_x.data();
  double* const momentum_r = grid.momentum_r.data();
  double* const force_x = grid.force_x.data();
  double* const force_r = grid.force_r.data();
  const std::ptrdiff_t row = grid.nodes_x;
  for_each_run(s, lanes, [&](std::ptrdiff_t first, Mask run) {
    const Pack mass = select(run, p.mass, Pack(0.0));
    const Pack volume = select(run, p.volume, Pack(0.0));
    const Pack rr = volume * p.stress_rr, xx = volume * p.stress_xx, tt = volume * p.stress_tt,
               rx = volume * p.stress_rx;
    Pack row_mass[3], fx_value[3], fx_slope[3], fr_value[3], fr_slope[3];
    for (int j = 0; j < 3; ++j) {
      row_mass[j] = mass * s.radial.value[j];
      fx_value[j] = -(rx * s.radial.gradient[j]);
      fx_slope[j] = -(xx * s.radial.value[j]);
      fr_value[j] = -(rr * s.radial.gradient[j] + tt * s.radial.hoop[j]);
      fr_slope[j] = -(rx * s.radial.value[j]);
    }
    for (int i = 0; i < 3; ++i) {  // outermost, so that overlapping stores are far apart
      const Pack value = s.axial.value[i], slope = s.axial.gradient[i];
      for (int j = 0; j < 3; ++j) {
        const std::ptrdiff_t node = first + j * row + i;
        const Pack part = row_mass[j] * value;
        detail::accumulate(node_mass + node, part);
        detail::accumulate(momentum_x + node, part * p.velocity_x);
        detail::accumulate(momentum_r + node, part * p.velocity_r);
        detail::accumulate(force_x + node, fx_value[j] * value + fx_slope[j] * slope);
        detail::accumulate(force_r + node, fr_value[j] * value + fr_slope[j] * slope);
      }
    }
  });
}

}  // namespace launchsafe::mpm
