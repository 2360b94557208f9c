#include "launchsafe/mpm/total_lagrangian.hpp"

#include "total_lagrangian_row.hpp"

namespace launchsafe::mpm {
namespace {

/// Means over the particle's interval of the hat functions of its cell [a, b], see Nairn & Guilkey 2015.
RowWeights row_weights(const Lattice& lattice, int j, double a, double b) {
  const double r = lattice.r_of(j), length = lattice.length_r(j), cell = b - a;
  RowWeights w;
  w.cell_row = j / lattice.stride;
  w.inverse_length = 1.0 / cell;
  w.value[1] = (r - a + length * length / (12.0 * r)) / cell;
  w.value[0] = 1.0 - w.value[1];
  w.hoop[1] = (r - a) / (cell * r);
  w.hoop[0] = (b - r) / (cell * r);
  return w;
}

}  // namespace

TotalLagrangian::TotalLagrangian(const scene::Scene& scene, std::vector<AnyBody>& bodies)
    : scene_(scene), bodies_(bodies), lines_(scene::grid_lines(scene)) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    nodes_.push_back(make_nodes(scene, lines_, static_cast<int>(b)));
    parts_.push_back(make_part(bodies[b], nodes_[b]));
    particle_totals_.emplace_back(parts_[b].rows.size());
    node_totals_.emplace_back(static_cast<std::size_t>(nodes_[b].rows));
  }
  lengthen_steps();
  sum_nodal_masses();
  ties_ = find_ties(nodes_, [&scene](std::size_t a, std::size_t b) {
    const scene::Interface* faces = scene::interface_between(scene, a, b);
    return faces != nullptr && scene::can_slide(*faces);
  });
  for (const Tie& tie : ties_) {
    double mass = 0.0, inertia_x = 0.0, inertia_r = 0.0;
    for (const Tie::Member& m : tie.members) {
      mass += nodes_[m.nodes].mass[m.index];
      inertia_x += nodes_[m.nodes].inertia_x[m.index];
      inertia_r += nodes_[m.nodes].inertia_r[m.index];
    }
    for (const Tie::Member& m : tie.members) {
      nodes_[m.nodes].inverse_inertia_x[m.index] = 1.0 / inertia_x;
      nodes_[m.nodes].inverse_inertia_r[m.index] = 1.0 / inertia_r;
      nodes_[m.nodes].mass_share[m.index] = mass / inertia_x;
    }
  }
  contact_ = std::make_unique<Contact>(scene, lines_, nodes_, ties_);
  // On faces at rest: steel turns and stretches too little to matter.
  for (const scene::ChamberFace& face : scene::chamber_of(scene).faces)
    face.across_x() ? load_across(face) : load_along(face);
  reset_grid();
}

TotalLagrangian::Part TotalLagrangian::make_part(const AnyBody& any, const Nodes& nodes) const {
  const ParticleFields& p = particle_fields_of(any);
  const Lattice& lattice = p.lattice;
  const scene::Numerics& numerics = scene_.numerics;
  Part part;
  for (int j = 0; j < lattice.rows(); ++j) {
    const auto line = static_cast<std::size_t>(nodes.first_r + j / lattice.stride);
    part.rows.push_back(row_weights(lattice, j, lines_.r[line], lines_.r[line + 1]));
  }
  const int cells = nodes.columns - 1;
  part.inverse_length.assign(nodes.stride, 0.0);
  for (int c = 0; c < cells; ++c) {
    const auto line = static_cast<std::size_t>(nodes.first_x + c);
    part.inverse_length[static_cast<std::size_t>(c)] = 1.0 / (lines_.x[line + 1] - lines_.x[line]);
  }
  if (lattice.stride > 1 || !(numerics.hourglass_stiffness > 0.0)) return part;
  const auto [modulus, density] = std::visit(
      [](const auto& body) {
        return std::pair{body.law.hourglass_modulus(), body.law.initial_density()};
      },
      any);
  part.hourglass.assign(lattice.slots(), 0.0);
  for (int j = 0; j < lattice.rows(); ++j)
    for (int i = 0; i < lattice.columns(); ++i) {
      const double a = lattice.length_x(i), b = lattice.length_r(j);
      const std::size_t slot = lattice.slot(i, j);
      part.hourglass[slot] = numerics.hourglass_stiffness * modulus * p.mass[slot] / density *
                             (1.0 / (a * a) + 1.0 / (b * b)) / 6.0;
    }
  return part;
}

void TotalLagrangian::load_across(const scene::ChamberFace& face) {
  const Nodes& n = nodes_[face.body];
  const Lattice& lattice = particle_fields_of(bodies_[face.body]).lattice;
  const int column = face.side == scene::BodySide::x_end ? n.columns - 1 : 0;
  for (int j = 0; j < lattice.rows(); ++j) {
    const double r = lattice.r_of(j);
    if (r < face.begin || r > face.end) continue;
    const RowWeights& w = parts_[face.body].rows[static_cast<std::size_t>(j)];
    const double force = face.direction() * r * lattice.length_r(j);
    for (int k = 0; k < 2; ++k) {
      const int row = w.cell_row + k;
      axial_load_.push_back({face.body, row, n.index(column, row), force * w.value[k]});
    }
  }
}

void TotalLagrangian::load_along(const scene::ChamberFace& face) {
  const Nodes& n = nodes_[face.body];
  const int row = face.side == scene::BodySide::r_end ? n.rows - 1 : 0;
  const double r = lines_.r[static_cast<std::size_t>(n.first_r + row)];
  for (int i = 0; i + 1 < n.columns; ++i) {
    const auto line = static_cast<std::size_t>(n.first_x + i);
    const double from = lines_.x[line], to = lines_.x[line + 1], middle = 0.5 * (from + to);
    if (middle < face.begin || middle > face.end) continue;
    const double force = face.direction() * 0.5 * r * (to - from);
    for (const int column : {i, i + 1}) radial_load_.push_back({face.body, row, n.index(column, row), force});
  }
}

void TotalLagrangian::reset_grid() {
  damped_before_ = 0.0;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    std::visit([&](auto& body) { momentum_to_nodes(body.particles, nodes_[b], parts_[b].rows); }, bodies_[b]);
  bond(ties_, nodes_);
  for (Nodes& n : nodes_)
    for (std::size_t node = 0; node < n.mass.size(); ++node) {
      n.velocity_x[node] =
          (n.inside.momentum_x[node] + n.outside.momentum_x[node]) * n.inverse_inertia_x[node];
      n.velocity_r[node] =
          (n.inside.momentum_r[node] + n.outside.momentum_r[node]) * n.inverse_inertia_r[node];
      n.velocity_increment_x[node] = n.velocity_increment_r[node] = 0.0;
    }
  if (contact_->any()) contact_->reset(nodes_);
}

double TotalLagrangian::stable_time_step() const {
  const bool selective = scene_.numerics.selective_inertia > 1.0;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    std::visit(
        [&](const auto& body) {
          const double time =
              shortest_sound_time(body, nodes_[b], parts_[b].rows, parts_[b].inverse_length, selective);
          if (!(time >= shortest)) shortest = time;  // NaN stays one
        },
        bodies_[b]);
  return scene_.numerics.time_step_factor * shortest;
}

void TotalLagrangian::load_nodes(const StepInput& input) {
  for (const LoadShare& share : axial_load_)
    nodes_[share.body].written(share.row).force_x[share.index] += input.pressure * share.force;
  for (const LoadShare& share : radial_load_)
    nodes_[share.body].written(share.row).force_r[share.index] += input.pressure * share.force;
  bond(ties_, nodes_);
}

double TotalLagrangian::chamber_flow() const {
  double flow = 0.0;
  for (const LoadShare& share : axial_load_) flow += share.force * nodes_[share.body].velocity_x[share.index];
  for (const LoadShare& share : radial_load_)
    flow += share.force * nodes_[share.body].velocity_r[share.index];
  return flow;
}

/// Moves a row of nodes. The losses keep the leapfrog balance of centred kinetic energy with mean forces
/// exact: with the change D of velocity in a step, the velocity v that the step moved by, and the momentum p
/// summed from the particles, the transfer to particles and back dissipates (D_old + D_new) (m v_old - p)/2.
void TotalLagrangian::move_row(Nodes& n, int row, const StepInput& input, NodeTotals& totals) const {
  const double dt = input.dt, damped = 1.0 / input.damping_factor - 1.0;
  totals = {};
  const std::size_t begin = n.index(0, row);
  for (std::size_t i = begin; i < begin + n.stride; i += math::pack_width) {
    const Pack inverse_x = load(n.inverse_inertia_x, i), inverse_r = load(n.inverse_inertia_r, i);
    const Pack inertia_x = load(n.inertia_x, i), inertia_r = load(n.inertia_r, i);
    const Pack share = load(n.mass_share, i), mass = load(n.mass, i);
    const Pack before_x = load(n.velocity_x, i), before_r = load(n.velocity_r, i);
    const Pack gained_x = load(n.velocity_increment_x, i), gained_r = load(n.velocity_increment_r, i);
    const Pack old_x = (load(n.inside.momentum_x, i) + load(n.outside.momentum_x, i)) * inverse_x;
    const Pack old_r = (load(n.inside.momentum_r, i) + load(n.outside.momentum_r, i)) * inverse_r;
    const Pack push_x =
        (load(n.inside.force_x, i) + load(n.outside.force_x, i)) * inverse_x + input.acceleration * share;
    const Pack push_r = (load(n.inside.force_r, i) + load(n.outside.force_r, i)) * inverse_r;
    const Pack new_x = (old_x + dt * push_x) * input.damping_factor;
    const Pack new_r = load(n.radially_free, i) * (old_r + dt * push_r) * input.damping_factor;
    const Pack velocity_increment_x = new_x - old_x, velocity_increment_r = new_r - old_r;
    store(n.velocity_x, i, new_x);
    store(n.velocity_r, i, new_r);
    store(n.velocity_increment_x, i, velocity_increment_x);
    store(n.velocity_increment_r, i, velocity_increment_r);
    store(n.displacement_x, i, load(n.displacement_x, i) + dt * new_x);
    store(n.displacement_r, i, load(n.displacement_r, i) + dt * new_r);
    const Pack half_x = 0.5 * inertia_x, half_r = 0.5 * inertia_r;
    totals.lost_before += half_x * ((gained_x + velocity_increment_x) * (before_x - old_x)) +
                          half_r * ((gained_r + velocity_increment_r) * (before_r - old_r));
    totals.lost_before += half_x * ((damped_before_ * before_x + damped * new_x) * before_x) +
                          half_r * ((damped_before_ * before_r + damped * new_r) * before_r);
    totals.old_momentum += inertia_x * old_x;
    totals.inertial_momentum += inertia_x * new_x;
    totals.momentum += mass * new_x;
  }
}

void TotalLagrangian::advance_body(std::size_t index, const StepInput& input) {
  const Part& part = parts_[index];
  std::visit(
      [&](auto& body) {
        const Lattice& lattice = body.particles.lattice;
        for (int j = 0; j < lattice.rows(); ++j) {
          ParticleTotals& totals = particle_totals_[index][static_cast<std::size_t>(j)];
          totals = {};
          const RowStep step{j,
                             part.rows[static_cast<std::size_t>(j)],
                             part.inverse_length,
                             part.hourglass,
                             input.dt,
                             input.pic_fraction,
                             j % lattice.stride == 0};
          if constexpr (std::decay_t<decltype(body.law)>::is_explosive) {
            if (body.particles.burning) {
              advance_burning_row(body, nodes_[index], step, totals);
              continue;
            }
          }
          advance_row<false>(body, nodes_[index], step, totals);
        }
      },
      bodies_[index]);
}

StepTotals TotalLagrangian::step(const StepInput& input) {
  load_nodes(input);
  for (AnyBody& any : bodies_) std::visit([&](auto& body) { body.integrator.set_step(input.dt); }, any);
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (int row = 0; row < nodes_[b].rows; ++row)
      move_row(nodes_[b], row, input, node_totals_[b][static_cast<std::size_t>(row)]);
  if (contact_->any()) contact_totals_ = contact_->act(nodes_, input);
  for (std::size_t b = 0; b < bodies_.size(); ++b) advance_body(b, input);
  damped_before_ = 1.0 / input.damping_factor - 1.0;
  StepTotals totals;
  for (const auto& body : particle_totals_)
    for (const ParticleTotals& row : body) totals.particles.add(row);
  totals.bulk.inertia = inertia_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    NodeTotals body;
    for (const NodeTotals& row : node_totals_[b]) body.add(row);
    totals.nodes.add(body);
    // Contact's impulses are equal and opposite: they do not change the whole momentum.
    totals.bulk.old_momentum += sum(body.old_momentum);
    totals.bulk.momentum += sum(body.inertial_momentum);
  }
  totals.chamber_flow = chamber_flow();
  totals.contact = contact_totals_;
  return totals;
}

}  // namespace launchsafe::mpm
