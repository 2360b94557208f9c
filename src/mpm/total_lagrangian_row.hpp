// One row of particles in the total-Lagrangian form: a Pack of neighbours at a time, which lie in
// neighbouring cells, read and write consecutive nodes.
#pragma once

#include "launchsafe/mpm/material_step.hpp"
#include "launchsafe/mpm/total_lagrangian.hpp"

namespace launchsafe::mpm {

/// A cell whose area or hoop stretch falls below this share, or whose volume grows beyond its inverse, has
/// left what strain measures and laws mean; strains of a launch are a few per cent.
inline constexpr double smallest_stretch = 0.05;

/// What a step and a row fix.
struct RowStep {
  int row;
  const RowWeights& weights;
  const math::AlignedArray& inverse_length;  ///< of the cells along x, 1/m
  const math::AlignedArray& hourglass;       ///< N/m by slot; empty without
  double dt;                                 ///< s
  double pic_fraction;
  bool first;  ///< in its row of cells: it writes the nodes' sums anew, later ones add to them
};

/// A nodal field in a Pack of cells, at the particles' share `s` of the cells' length from the left: in the
/// row of nodes towards the axis (0) and in the one away from it (1).
struct CellField {
  Pack value[2];       ///< at s
  Pack difference[2];  ///< right less left

  /// d/dx, 1/m, from the difference along x in both rows.
  Pack slope_x(const RowWeights& w, Pack inverse_length) const {
    return (w.value[0] * difference[0] + w.value[1] * difference[1]) * inverse_length;
  }
  Pack slope_r(const RowWeights& w) const { return (value[1] - value[0]) * Pack(w.inverse_length); }
  Pack mean(const double weight[2]) const { return weight[0] * value[0] + weight[1] * value[1]; }
  /// Amplitude of the hourglass mode, a quarter of the corners' alternating sum.
  Pack hourglass() const { return 0.25 * (difference[1] - difference[0]); }
};

/// From the nodes at the left ends of the cells, by row.
inline CellField cell_field(const math::AlignedArray& field, std::size_t inner, std::size_t outer, double s) {
  const Pack left[2] = {load(field, inner), load(field, outer)};
  const Pack difference[2] = {load(field, inner + 1) - left[0], load(field, outer + 1) - left[1]};
  return {{left[0] + s * difference[0], left[1] + s * difference[1]}, {difference[0], difference[1]}};
}

/// Deformation gradient dx_i/dX_J, or a change of it: first index the present, second the rest; tt the hoop.
struct Gradient {
  Pack rr, xx, rx, xr, tt;
};

inline Gradient gradient_of(const CellField& x, const CellField& r, const RowWeights& w,
                            Pack inverse_length) {
  return {r.slope_r(w), x.slope_x(w, inverse_length), r.slope_x(w, inverse_length), x.slope_r(w),
          r.mean(w.hoop)};
}

/// The alternating writes of a row: a node gets the right share of the cell before it and the left share of
/// the cell after it.
class NodeRow {
 public:
  NodeRow(double* sums, bool first) : sums_(sums), first_(first) {}
  void add(std::size_t i, Pack left, Pack right) {
    const Pack both = left + math::moved_up(carried_, right);
    carried_ = right;
    (first_ ? both : Pack::load(sums_ + i) + both).store(sums_ + i);
  }
  /// The node after the last Pack: it ends the row where the cells fill their Packs.
  void finish(std::size_t i) { sums_[i] = (first_ ? 0.0 : sums_[i]) + carried_[math::pack_width - 1]; }

 private:
  double* sums_;
  Pack carried_{0.0};
  bool first_;
};

/// The four sums of one node row.
struct NodeRows {
  NodeRow momentum_x, momentum_r, force_x, force_r;
  NodeRows(NodeSums& sums, std::size_t begin, bool first)
      : momentum_x(sums.momentum_x.data() + begin, first),
        momentum_r(sums.momentum_r.data() + begin, first),
        force_x(sums.force_x.data() + begin, first),
        force_r(sums.force_r.data() + begin, first) {}
  void finish(std::size_t i) {
    momentum_x.finish(i);
    momentum_r.finish(i);
    force_x.finish(i);
    force_r.finish(i);
  }
};

/// Deformation of the step from F at its end and the change dF in it. With F at the middle, the strain and
/// spin increments are those of dF F^-1.
inline Deformation deformation_of(const Gradient& f, const Gradient& d, Pack rest_volume, Pack volume_before,
                                  Pack area) {
  const Pack rr = f.rr - 0.5 * d.rr, xx = f.xx - 0.5 * d.xx, rx = f.rx - 0.5 * d.rx, xr = f.xr - 0.5 * d.xr,
             tt = f.tt - 0.5 * d.tt;
  const Pack determinant = rr * xx - rx * xr;
  const Pack inverse = 1.0 / (determinant * tt);
  const Pack plane = inverse * tt, hoop = inverse * determinant;
  // dF F^-1 with F^-1 = [[xx, -rx], [-xr, rr]]/determinant.
  const Pack l_rr = (d.rr * xx - d.rx * xr) * plane, l_rx = (d.rx * rr - d.rr * rx) * plane;
  const Pack l_xr = (d.xr * xx - d.xx * xr) * plane, l_xx = (d.xx * rr - d.xr * rx) * plane;
  const Pack l_tt = d.tt * hoop;
  const Pack third = (l_rr + l_xx + l_tt) * (1.0 / 3.0);
  Deformation result;
  result.increment.deviator = {l_rr - third, l_xx - third, 0.5 * (l_rx + l_xr)};
  result.increment.rotation = math::rotation_of(0.5 * (l_rx - l_xr));
  result.increment.volume_before = volume_before;
  result.increment.volume_after = area * f.tt;  // J
  result.rest_volume = rest_volume;
  return result;
}

/// Force of the stress in a Pack of cells on their corners, f = -V0 P grad0 N, of one direction.
struct CornerForces {
  Pack along_r, along_x, hoop, hourglass;  ///< N: V0 P_iR/dr, V0 P_iX/dx, V0 P_tt (m N), k q

  void give(const RowWeights& w, double s, std::size_t i, NodeRow& inner, NodeRow& outer) const {
    const Pack on_inner = along_r - w.hoop[0] * hoop, on_outer = -along_r - w.hoop[1] * hoop;
    const Pack apart_inner = w.value[0] * along_x - hourglass, apart_outer = w.value[1] * along_x + hourglass;
    inner.add(i, (1.0 - s) * on_inner + apart_inner, s * on_inner - apart_inner);
    outer.add(i, (1.0 - s) * on_outer + apart_outer, s * on_outer - apart_outer);
  }
};

/// Advances one row of particles by a step and gives it to the nodes. `burns`: see update_material.
template <bool burns, class Law>
[[gnu::flatten]] void advance_row(Body<Law>& body, Nodes& nodes, const RowStep& step,
                                  ParticleTotals& totals) {
  ParticleFields& p = body.particles;
  const RowWeights& w = step.weights;
  const Lattice& lattice = p.lattice;
  const std::size_t inner = nodes.index(0, w.cell_row), outer = nodes.index(0, w.cell_row + 1);
  const double per_density = 1.0 / body.law.initial_density();
  const auto columns = static_cast<std::size_t>(lattice.padded_columns / lattice.stride);
  std::size_t slot = static_cast<std::size_t>(step.row) * static_cast<std::size_t>(lattice.padded_columns);
  for (int subrow = 0; subrow < lattice.stride; ++subrow) {
    const double s = (subrow + 0.5) / lattice.stride;
    const bool first = step.first && subrow == 0;
    NodeRows to_inner(nodes.outside, inner, first), to_outer(nodes.inside, outer, first);
    for (std::size_t i = 0; i < columns; i += math::pack_width, slot += math::pack_width) {
      const Pack inverse_length = load(step.inverse_length, i);
      const Mask real = inverse_length > Pack(0.0);
      const Pack mass = load(p.mass, slot);
      const auto in_cells = [&](const math::AlignedArray& field) {
        return cell_field(field, inner + i, outer + i, s);
      };
      const CellField vx = in_cells(nodes.velocity_x), vr = in_cells(nodes.velocity_r);
      const CellField ux = in_cells(nodes.displacement_x), ur = in_cells(nodes.displacement_r);
      const auto in_cell = [real](Pack value) { return select(real, value, Pack(0.0)); };
      const auto masked = [&](const Gradient& g) {
        return Gradient{in_cell(g.rr), in_cell(g.xx), in_cell(g.rx), in_cell(g.xr), in_cell(g.tt)};
      };
      Gradient d = masked(gradient_of(vx, vr, w, inverse_length));
      for (Pack* part : {&d.rr, &d.xx, &d.rx, &d.xr, &d.tt}) *part *= step.dt;
      Gradient f = masked(gradient_of(ux, ur, w, inverse_length));
      f.rr += 1.0;
      f.xx += 1.0;
      f.tt += 1.0;

      const Pack grid_x = in_cell(vx.mean(w.value)), grid_r = in_cell(vr.mean(w.value));
      const Pack inertia_x = load(p.inertia_x, slot), inertia_r = load(p.inertia_r, slot);
      update_velocity(p, slot, inertia_x, inertia_r,
                      in_cell(in_cells(nodes.velocity_increment_x).mean(w.value)),
                      in_cell(in_cells(nodes.velocity_increment_r).mean(w.value)), grid_x, grid_r,
                      step.pic_fraction, totals);
      store(p.x, slot, load(p.x, slot) + step.dt * grid_x);
      store(p.r, slot, load(p.r, slot) + step.dt * grid_r);

      const Pack momentum_x = inertia_x * load(p.velocity_x, slot),
                 momentum_r = inertia_r * load(p.velocity_r, slot);
      to_inner.momentum_x.add(i, (w.value[0] * (1.0 - s)) * momentum_x, (w.value[0] * s) * momentum_x);
      to_inner.momentum_r.add(i, (w.value[0] * (1.0 - s)) * momentum_r, (w.value[0] * s) * momentum_r);
      to_outer.momentum_x.add(i, (w.value[1] * (1.0 - s)) * momentum_x, (w.value[1] * s) * momentum_x);
      to_outer.momentum_r.add(i, (w.value[1] * (1.0 - s)) * momentum_r, (w.value[1] * s) * momentum_r);

      Pack hourglass_x(0.0), hourglass_r(0.0);
      if (!step.hourglass.empty()) {
        const Pack stiffness = load(step.hourglass, slot), half_step(0.5 * step.dt);
        const Pack qx = ux.hourglass(), qr = ur.hourglass(), dqx = vx.hourglass(), dqr = vr.hourglass();
        hourglass_x = stiffness * qx;
        hourglass_r = stiffness * qr;
        totals.hourglass +=
            Pack(4.0 * step.dt) * stiffness * ((qx - half_step * dqx) * dqx + (qr - half_step * dqr) * dqr);
      }

      const Pack volume = mass * per_density;
      const Pack area = f.rr * f.xx - f.rx * f.xr;
      const Mask sound = (area > Pack(smallest_stretch)) & (f.tt > Pack(smallest_stretch)) &
                         (area * f.tt < Pack(1.0 / smallest_stretch));
      totals.distorted += select(sound, Pack(0.0), Pack(1.0));
      const Deformation deformation = deformation_of(f, d, volume, load(p.volume_ratio, slot), area);
      const StressUpdate stress = update_material<burns>(body, slot, deformation, totals);

      // P = J sigma F^-T, in the plane J F^-T = tt [[xx, -xr], [-rx, rr]].
      const Pack rr = stress.deviator.rr - stress.pressure, xx = stress.deviator.xx - stress.pressure,
                 rx = stress.deviator.rx, tt = stress.deviator.tt() - stress.pressure;
      const Pack scaled = volume * f.tt, per_r = scaled * w.inverse_length, per_x = scaled * inverse_length;
      CornerForces on_x{per_r * (rx * f.xx - xx * f.rx), per_x * (xx * f.rr - rx * f.xr), Pack(0.0),
                        hourglass_x};
      CornerForces on_r{per_r * (rr * f.xx - rx * f.rx), per_x * (rx * f.rr - rr * f.xr), volume * tt * area,
                        hourglass_r};
      on_x.give(w, s, i, to_inner.force_x, to_outer.force_x);
      on_r.give(w, s, i, to_inner.force_r, to_outer.force_r);
    }
    if (static_cast<std::size_t>(nodes.columns) == columns + 1) {
      to_inner.finish(columns);
      to_outer.finish(columns);
    }
  }
}

/// `advance_row` of a body with `ParticleFields::burning`.
void advance_burning_row(Body<materials::Charge>& body, Nodes& nodes, const RowStep& step,
                         ParticleTotals& totals);

/// Gives the particles' momentum to empty nodes.
inline void momentum_to_nodes(const ParticleFields& p, Nodes& nodes, const std::vector<RowWeights>& rows) {
  for (NodeSums* sums : {&nodes.inside, &nodes.outside}) {
    std::fill(sums->momentum_x.begin(), sums->momentum_x.end(), 0.0);
    std::fill(sums->momentum_r.begin(), sums->momentum_r.end(), 0.0);
  }
  const Lattice& lattice = p.lattice;
  for (int j = 0; j < lattice.rows(); ++j)
    for (int i = 0; i < lattice.columns(); ++i) {
      const RowWeights& w = rows[static_cast<std::size_t>(j)];
      const std::size_t slot = lattice.slot(i, j);
      const double right = ((i % lattice.stride) + 0.5) / lattice.stride;
      for (int k = 0; k < 2; ++k) {
        NodeSums& sums = k == 0 ? nodes.outside : nodes.inside;
        const std::size_t node = nodes.index(i / lattice.stride, w.cell_row + k);
        const double x = p.inertia_x[slot] * w.value[k] * p.velocity_x[slot],
                     r = p.inertia_r[slot] * w.value[k] * p.velocity_r[slot];
        sums.momentum_x[node] += (1.0 - right) * x;
        sums.momentum_r[node] += (1.0 - right) * r;
        sums.momentum_x[node + 1] += right * x;
        sums.momentum_r[node + 1] += right * r;
      }
    }
}

/// Shortest time (s) in which sound crosses the height of a cell of the body as it is deformed, with the
/// inertia that its particle has. `selective`: inertia differs along x and r, and shear across the one counts
/// with stretch along the other (TotalLagrangian::lengthen_steps).
template <class Law>
double shortest_sound_time(const Body<Law>& body, const Nodes& nodes, const std::vector<RowWeights>& rows,
                           const math::AlignedArray& inverse_lengths, bool selective) {
  const Lattice& lattice = body.particles.lattice;
  const auto columns = static_cast<std::size_t>(lattice.padded_columns / lattice.stride);
  const double shear_squared = selective ? body.law.shear_modulus() / body.law.initial_density() : 0.0;
  Pack fastest(0.0);  // (sound speed over height)^2, 1/s2
  std::size_t slot = 0;
  for (const RowWeights& w : rows)
    for (int subrow = 0; subrow < lattice.stride; ++subrow)
      for (std::size_t i = 0; i < columns; i += math::pack_width, slot += math::pack_width) {
        const double s = (subrow + 0.5) / lattice.stride;
        const std::size_t inner = nodes.index(static_cast<int>(i), w.cell_row),
                          outer = nodes.index(static_cast<int>(i), w.cell_row + 1);
        const Pack inverse_length = load(inverse_lengths, i);
        const Mask real = inverse_length > Pack(0.0);
        const Gradient g = gradient_of(cell_field(nodes.displacement_x, inner, outer, s),
                                       cell_field(nodes.displacement_r, inner, outer, s), w, inverse_length);
        const Pack rr = 1.0 + g.rr, xx = 1.0 + g.xx;
        const Pack area = rr * xx - g.rx * g.xr;
        // Height along x: area over the edge along r, and the other way round.
        const Pack along_r = (rr * rr + g.xr * g.xr) * (inverse_length * inverse_length);
        const Pack along_x = (xx * xx + g.rx * g.rx) * Pack(w.inverse_length * w.inverse_length);
        const ParticleFields& p = body.particles;
        const Pack mass = load(p.mass, slot);
        const Pack sound = sound_speed_squared(body, slot);
        const Pack shear = Pack(shear_squared) * load(p.volume_ratio, slot);
        const Pack motion_x = (sound * along_r + shear * along_x) * (mass / load(p.inertia_x, slot)),
                   motion_r = (sound * along_x + shear * along_r) * (mass / load(p.inertia_r, slot));
        const Pack rate = max(motion_x, motion_r) / (area * area);
        const Pack counted = select(real, rate, Pack(0.0));
        fastest = select(counted <= fastest, fastest, counted);  // NaN wins
      }
  return 1.0 / std::sqrt(math::largest(fastest));
}

}  // namespace launchsafe::mpm
