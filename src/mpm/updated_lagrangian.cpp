#include "launchsafe/mpm/updated_lagrangian.hpp"

#include "launchsafe/mpm/material_step.hpp"

namespace launchsafe::mpm {
namespace {

/// Nodes lighter than this share of a cell of the lightest material hold no more than round-off; they do not
/// move.
constexpr double empty_node_share = 1e-12;

/// Of any body at rest, kg/m3.
double lightest_density(const std::vector<AnyBody>& bodies) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const AnyBody& any : bodies)
    lightest =
        std::min(lightest, std::visit([](const auto& body) { return body.law.initial_density(); }, any));
  return lightest;
}

/// Half-lengths of the particles of an evenly divided body, m.
double half_x(const ParticleFields& p) { return 0.5 * p.lattice.length_x(0); }
double half_r(const ParticleFields& p) { return 0.5 * p.lattice.length_r(0); }

/// What a step fixes for all bodies.
struct Transfer {
  double dt = 0;            ///< s
  double read_origin = 0;   ///< window of the grid that is read, m
  double write_origin = 0;  ///< window of the grid that is written, m
  double pic_fraction = 0;
};

Deformation deformation_of(const GridToParticle& g, double dt, Pack rest_volume, Pack volume) {
  const Pack volumetric = (g.rate_rr + g.rate_xx + g.rate_tt) * dt;
  const Pack third = volumetric * (1.0 / 3.0);
  // V exp(tr) to second order.
  const Pack volume_after = volume * (1.0 + 0.5 * volumetric) / (1.0 - 0.5 * volumetric);
  return {{{g.rate_rr * dt - third, g.rate_xx * dt - third, (g.vr_by_x + g.vx_by_r) * (0.5 * dt)},
           math::rotation_of((g.vr_by_x - g.vx_by_r) * (0.5 * dt)),
           volume,
           volume_after},
          rest_volume};
}

/// Everything but the rare sub-steps is inlined: a call would pass its Packs through memory.
template <class Law>
[[gnu::flatten]] void advance_body(Body<Law>& body, Grid& grid, const Transfer& transfer,
                                   ParticleTotals& totals) {
  ParticleFields& p = body.particles;
  const StencilContext reading{grid, transfer.read_origin, half_x(p), half_r(p)};
  const StencilContext writing{grid, transfer.write_origin, half_x(p), half_r(p)};
  for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width) {
    const Pack mass = load(p.mass, slot);
    const Mask real = mass > Pack(0.0);
    const Pack x0 = load(p.x, slot), r0 = load(p.r, slot);
    const Stencil old_stencil = stencil_of(reading, x0, r0);
    const GridToParticle g = grid_to_particle(grid, old_stencil, real & old_stencil.inside);
    update_velocity(p, slot, mass, mass, g.velocity_increment_x, g.velocity_increment_r, g.velocity_x,
                    g.velocity_r, transfer.pic_fraction, totals);
    const Pack x1 = x0 + transfer.dt * g.velocity_x, r1 = r0 + transfer.dt * g.velocity_r;
    store(p.x, slot, x1);
    store(p.r, slot, r1);
    const Pack rest_volume = mass * (1.0 / body.law.initial_density());
    const Deformation deformation = deformation_of(g, transfer.dt, rest_volume, load(p.volume_ratio, slot));
    const StressUpdate s = update_material<false>(body, slot, deformation, totals);

    const Stencil stencil = stencil_of(writing, x1, r1);
    totals.off_grid += select(real & !stencil.inside, Pack(1.0), Pack(0.0));
    const ParticleToGrid given{mass,
                               load(p.velocity_x, slot),
                               load(p.velocity_r, slot),
                               rest_volume * deformation.increment.volume_after,
                               s.deviator.rr - s.pressure,
                               s.deviator.xx - s.pressure,
                               s.deviator.tt() - s.pressure,
                               s.deviator.rx};
    particle_to_grid(grid, stencil, given, real & stencil.inside);
  }
}

/// Gives a body at rest and free of stress to an empty grid: mass and momentum only.
void initial_particle_to_grid(const ParticleFields& p, Grid& grid) {
  const StencilContext writing{grid, grid.origin_x, half_x(p), half_r(p)};
  for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width) {
    const Pack mass = load(p.mass, slot);
    const Stencil stencil = stencil_of(writing, load(p.x, slot), load(p.r, slot));
    const Pack none(0.0);
    const ParticleToGrid given{
        mass, load(p.velocity_x, slot), load(p.velocity_r, slot), none, none, none, none, none};
    particle_to_grid(grid, stencil, given, (mass > none) & stencil.inside);
  }
}

}  // namespace

UpdatedLagrangian::UpdatedLagrangian(const scene::Scene& scene, std::vector<AnyBody>& bodies)
    : scene_(scene), bodies_(bodies), grid_(make_grid(scene)), base_origin_(grid_.origin_x) {
  const double base = scene::extent_of(scene).x_end;
  const bool has_charge = scene::has_charge(scene);
  const double bottom = has_charge ? scene::charge_extent(scene).x_end : base;
  for (const AnyBody& any : bodies) {
    const ParticleFields& p = particle_fields_of(any);
    const Lattice& lattice = p.lattice;
    for (const double mass : p.mass) total_mass_ += mass;
    const scene::Body& body = scene.bodies[static_cast<std::size_t>(p.body)];
    const int last = lattice.columns() - 1;
    for (int j = 0; body.x_end >= base && j < lattice.rows(); ++j)
      faces_.push_back({&p, lattice.slot(last, j), lattice.r_of(j) * lattice.length_r(j)});
    if (body.x_end != bottom || scene::is_charge(scene, body) != has_charge) continue;
    for (int j = 0; j < lattice.rows(); ++j)
      anchors_.push_back({&p, lattice.slot(last, j), lattice.x_of(last)});
  }
  reset_grid();
}

/// The grid follows the charge bottom, so that particles there stay in their cells: crossing cells beside the
/// steel makes the stresses of neighbouring particles alternate, and the skin temperatures with them.
double UpdatedLagrangian::window_origin() const {
  double displacement = 0.0;
  for (const Anchor& anchor : anchors_) displacement += anchor.body->x[anchor.slot] - anchor.initial_x;
  return base_origin_ + displacement / static_cast<double>(anchors_.size());
}

void UpdatedLagrangian::reset_grid() {
  for (auto* field : {&grid_.mass, &grid_.momentum_x, &grid_.momentum_r, &grid_.force_x, &grid_.force_r})
    std::fill(field->begin(), field->end(), 0.0);
  for (const AnyBody& body : bodies_) initial_particle_to_grid(particle_fields_of(body), grid_);
}

double UpdatedLagrangian::stable_time_step() const {
  Pack sound(0.0), particle(0.0);
  for (const AnyBody& any : bodies_) {
    std::visit(
        [&]<class Law>(const Body<Law>& body) {
          const ParticleFields& p = body.particles;
          for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width) {
            sound = max(sound_speed_squared(body, slot), sound);
            particle =
                max(math::abs(load(p.velocity_x, slot)) + math::abs(load(p.velocity_r, slot)), particle);
          }
        },
        any);
  }
  const double speed =
      std::sqrt(math::largest(sound) / scene_.numerics.inertial_scaling) + math::largest(particle);
  return scene_.numerics.time_step_factor * std::min(grid_.dx, grid_.dr) / speed;
}

/// The base face as nodal forces per unit pressure: cut by the linear hat functions in x at its present place
/// and weighted in r like its particles, so a uniform stress balances it exactly.
void UpdatedLagrangian::locate_load() {
  load_shares_.clear();
  for (const LoadedFace& face : faces_) {
    const ParticleFields& p = *face.body;
    const StencilContext context{grid_, grid_.origin_x, half_x(p), half_r(p)};
    const Stencil stencil = stencil_of(context, Pack(p.x[face.slot]), Pack(p.r[face.slot]));
    if (stencil.inside.lanes[0] == 0) continue;
    const double coordinate = (p.x[face.slot] + half_x(p) - grid_.origin_x) / grid_.dx;
    const double cell = std::floor(coordinate), share = coordinate - cell;
    const auto nodes_x = static_cast<std::size_t>(grid_.nodes_x);
    const auto row = static_cast<std::size_t>(stencil.first[0]) / nodes_x;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t node = (row + j) * nodes_x + static_cast<std::size_t>(cell);
      const double force = -face.area * stencil.radial.value[j][0];
      load_shares_.push_back({node, force * (1.0 - share)});
      load_shares_.push_back({node + 1, force * share});
    }
  }
}

void UpdatedLagrangian::update_grid(const StepInput& input, NodeTotals& totals) {
  const double scaling = scene_.numerics.inertial_scaling;
  const double dt = input.dt, damping_factor = input.damping_factor;
  const double lightest = empty_node_share * lightest_density(bodies_) * grid_.dx * grid_.dr * grid_.dr;
  // Nodes are padded to whole Packs; the rows' ends may share one, so the radial condition is given by node.
  Pack old_transport(0.0), axial_transport(0.0), damping(0.0);
  const Pack none(0.0);
  for (std::size_t n = 0; n < grid_.mass.size(); n += math::pack_width) {
    const Pack mass = Pack::load(&grid_.mass[n]), radially_free = Pack::load(&grid_.radially_free[n]);
    const Mask used = mass > Pack(lightest);
    const Pack inverse = select(used, 1.0 / mass, none);
    const Pack old_x = Pack::load(&grid_.momentum_x[n]) * inverse,
               old_r = Pack::load(&grid_.momentum_r[n]) * inverse;
    const Pack push_x =
        Pack::load(&grid_.force_x[n]) * inverse + select(used, Pack(input.acceleration), none);
    const Pack push_r = Pack::load(&grid_.force_r[n]) * inverse;
    const Pack free_x = old_x + push_x * (dt / scaling),
               free_r = radially_free * (old_r + push_r * (dt / scaling));
    const Pack new_x = free_x * damping_factor, new_r = free_r * damping_factor;
    damping += 0.5 * mass * (free_x * free_x - new_x * new_x + free_r * free_r - new_r * new_r);
    old_transport += mass * old_x;
    axial_transport += mass * new_x;
    new_x.store(&grid_.velocity_x[n]);
    new_r.store(&grid_.velocity_r[n]);
    (new_x - old_x).store(&grid_.velocity_increment_x[n]);
    (new_r - old_r).store(&grid_.velocity_increment_r[n]);
    for (auto* sums : {&grid_.mass, &grid_.momentum_x, &grid_.momentum_r, &grid_.force_x, &grid_.force_r})
      none.store(sums->data() + n);
  }
  totals.damping = scaling * damping;
  totals.old_momentum = scaling * old_transport;
  totals.inertial_momentum = scaling * axial_transport;
  totals.momentum = axial_transport;
}

StepTotals UpdatedLagrangian::step(const StepInput& input) {
  StepTotals totals;
  locate_load();
  for (const LoadShare& share : load_shares_) grid_.force_x[share.node] += input.pressure * share.force;
  update_grid(input, totals.nodes);
  const double scaling = scene_.numerics.inertial_scaling;
  totals.bulk = {scaling * total_mass_, sum(totals.nodes.old_momentum), sum(totals.nodes.inertial_momentum)};
  for (const LoadShare& share : load_shares_)
    totals.chamber_flow += share.force * grid_.velocity_x[share.node];

  Transfer transfer{input.dt, grid_.origin_x, 0.0, input.pic_fraction};
  grid_.origin_x = transfer.write_origin = window_origin();
  for (AnyBody& any : bodies_) {
    std::visit(
        [&]<class Law>(Body<Law>& body) {
          body.integrator.set_step(input.dt);
          advance_body(body, grid_, transfer, totals.particles);
        },
        any);
  }
  totals.particles.centred_kinetic *= scene_.numerics.inertial_scaling;
  totals.particles.pic_loss *= scene_.numerics.inertial_scaling;
  return totals;
}

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
