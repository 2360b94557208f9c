#include "launchsafe/mpm/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace launchsafe::mpm {
namespace {

/// Nodes lighter than this share of a steel cell hold no more than round-off; they do not move.
constexpr double empty_node_share = 1e-12;

double radial_measure(bool axisymmetric, double r) { return axisymmetric ? r : 1.0; }

}  // namespace

Simulation::Simulation(scene::Scene scene)
    : scene_(std::move(scene)), load_(scene_.load), grid_(make_grid(scene_)), base_origin_(grid_.origin_x) {
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    if (scene_.bodies[i].material == scene::BodyMaterial::steel)
      steel_.push_back(make_steel_body(scene_, static_cast<int>(i)));
    else
      charges_.push_back(make_charge_body(scene_, static_cast<int>(i)));
  }
  const double base = scene::extent_of(scene_).x_end;
  for_each_body([&](const Kinematics& p) {
    for (const double mass : p.mass) {
      total_mass_ += mass;
      particles_ += mass > 0.0 ? 1 : 0;
    }
    if (scene_.bodies[static_cast<std::size_t>(p.body)].x_end < base) return;
    for (int j = 0; j < p.lattice.rows; ++j) {
      const std::size_t slot = p.lattice.slot(p.lattice.columns - 1, j);
      faces_.push_back({&p, slot, radial_measure(axisymmetric(), p.lattice.r_of(j)) * p.lattice.spacing_r});
      loaded_area_ += faces_.back().area;
    }
  });
  const bool has_charge = !charges_.empty();
  const double bottom = has_charge ? scene::extent_of(scene_, scene::BodyMaterial::charge).x_end : base;
  for_each_body([&](const Kinematics& p) {
    const scene::Body& body = scene_.bodies[static_cast<std::size_t>(p.body)];
    if (body.x_end != bottom || (body.material == scene::BodyMaterial::charge) != has_charge) return;
    for (int j = 0; j < p.lattice.rows; ++j)
      anchors_.push_back(
          {&p, p.lattice.slot(p.lattice.columns - 1, j), p.lattice.x_of(p.lattice.columns - 1)});
  });
  restart();
}

/// The co-moving grid rides with the charge bottom, so that particles there stay in their cells: crossing
/// cells beside the steel makes the stresses of neighbouring particles alternate, and the skin temperatures
/// with them. The lab's grid stands still; its window follows by whole cells.
double Simulation::window_origin() const {
  if (scene_.frame == scene::Frame::lab) return base_origin_ + std::round(travel_ / grid_.dx) * grid_.dx;
  double displacement = 0.0;
  for (const Anchor& anchor : anchors_) displacement += anchor.body->x[anchor.slot] - anchor.initial_x;
  return base_origin_ + displacement / static_cast<double>(anchors_.size());
}

void Simulation::restart() {
  for (auto* field : {&grid_.mass, &grid_.momentum_x, &grid_.momentum_r, &grid_.force_x, &grid_.force_r})
    std::fill(field->begin(), field->end(), 0.0);
  const StepContext context = context_of(0.0);
  for_each_body([&](const Kinematics& p) { scatter_initial(p, grid_, context); });
}

StepContext Simulation::context_of(double dt) const {
  StepContext context;
  context.dt = dt;
  context.read_origin = context.write_origin = grid_.origin_x;
  context.pic_fraction = scene_.numerics.pic_fraction;
  context.axisymmetric = axisymmetric();
  if (dt > 0.0 && !charges_.empty()) context.relaxation = materials::relaxation(scene_.charge.cracks, dt);
  return context;
}

double Simulation::frame_acceleration(double time) const {
  return scene_.frame == scene::Frame::co_moving ? load_.at(time) * loaded_area_ / total_mass_ : 0.0;
}

double Simulation::stable_time_step() const {
  double sound_squared = 0.0, particle = 0.0;
  const auto include = [&](const Speeds& speeds) {
    sound_squared = std::max(sound_squared, speeds.sound_squared);
    particle = std::max(particle, speeds.particle);
  };
  for (const SteelBody& body : steel_) include(speeds_of(body, scene_.steel));
  for (const ChargeBody& body : charges_) include(speeds_of(body, scene_.charge));
  const double sound = std::sqrt(sound_squared / scene_.numerics.inertial_scaling);
  return scene_.numerics.time_step_factor * std::min(grid_.dx, grid_.dr) / (sound + particle);
}

/// The base face as nodal forces per unit pressure: cut by the linear hat functions in x at its present place
/// and weighted in r like its particles, so a uniform stress balances it exactly.
void Simulation::locate_load() {
  load_shares_.clear();
  for (const LoadedFace& face : faces_) {
    const Kinematics& p = *face.body;
    const StencilContext context{grid_, grid_.origin_x, p.half_x, p.half_r, axisymmetric()};
    const Stencil stencil = stencil_of(context, Pack(p.x[face.slot]), Pack(p.r[face.slot]));
    if (stencil.inside.lanes[0] == 0) continue;
    const double coordinate = (p.x[face.slot] + p.half_x - grid_.origin_x) / grid_.dx;
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

void Simulation::press_bore(int body, double pressure) {
  for_each_body([&](const Kinematics& p) {
    if (p.body == body) bores_.push_back({&p, pressure});
  });
}

/// The inner faces as radial nodal forces, cut by the linear hat functions in r at their present place and
/// weighted in x like their particles.
void Simulation::locate_bores() {
  bore_shares_.clear();
  for (const Bore& bore : bores_) {
    const Kinematics& p = *bore.body;
    const StencilContext context{grid_, grid_.origin_x, p.half_x, p.half_r, axisymmetric()};
    for (int i = 0; i < p.lattice.columns; ++i) {
      const std::size_t slot = p.lattice.slot(i, 0);
      const Stencil stencil = stencil_of(context, Pack(p.x[slot]), Pack(p.r[slot]));
      if (stencil.inside.lanes[0] == 0) continue;
      const double face = p.r[slot] - p.half_r;
      const double force = bore.pressure * radial_measure(axisymmetric(), face) * p.lattice.spacing_x;
      const double coordinate = face / grid_.dr + Grid::radial_padding;
      const double cell = std::floor(coordinate), share = coordinate - cell;
      const auto nodes_x = static_cast<std::size_t>(grid_.nodes_x);
      const std::size_t column = static_cast<std::size_t>(stencil.first[0]) % nodes_x;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t node = static_cast<std::size_t>(cell) * nodes_x + column + k;
        bore_shares_.push_back({node, force * (1.0 - share) * stencil.axial.value[k][0]});
        bore_shares_.push_back({node + nodes_x, force * share * stencil.axial.value[k][0]});
      }
    }
  }
}

void Simulation::update_grid(double dt) {
  const double scaling = scene_.numerics.inertial_scaling;
  // Taken when the pressure is, so that the two balance; its work is the step's mean, as the pressure's is.
  const double acceleration = frame_acceleration(time_);
  const double mean_acceleration = 0.5 * (acceleration + frame_acceleration(time_ + dt));
  const double keep = scene_.numerics.damping_time > 0.0 ? std::exp(-dt / scene_.numerics.damping_time) : 1.0;
  const double lightest = empty_node_share * scene_.charge.eos.initial_density * grid_.dx * grid_.dr *
                          radial_measure(axisymmetric(), grid_.dr);
  // Nodes are padded to whole Packs; the rows' ends may share one, so the radial condition is given by node.
  Pack old_transport(0.0), axial_transport(0.0), damping(0.0);
  const Pack none(0.0);
  for (std::size_t n = 0; n < grid_.mass.size(); n += math::pack_width) {
    const Pack mass = Pack::load(&grid_.mass[n]), moves_r = Pack::load(&grid_.moves_r[n]);
    const Mask used = mass > Pack(lightest);
    const Pack inverse = select(used, 1.0 / mass, none);
    const Pack old_x = Pack::load(&grid_.momentum_x[n]) * inverse,
               old_r = Pack::load(&grid_.momentum_r[n]) * inverse;
    const Pack push_x = Pack::load(&grid_.force_x[n]) * inverse + select(used, Pack(acceleration), none);
    const Pack push_r = Pack::load(&grid_.force_r[n]) * inverse;
    const Pack free_x = old_x + push_x * (dt / scaling), free_r = moves_r * (old_r + push_r * (dt / scaling));
    const Pack new_x = free_x * keep, new_r = free_r * keep;
    damping += 0.5 * mass * (free_x * free_x - new_x * new_x + free_r * free_r - new_r * new_r);
    old_transport += mass * old_x;
    axial_transport += mass * new_x;
    new_x.store(&grid_.velocity_x[n]);
    new_r.store(&grid_.velocity_r[n]);
    (new_x - old_x).store(&grid_.change_x[n]);
    (new_r - old_r).store(&grid_.change_r[n]);
    for (auto* sums : {&grid_.mass, &grid_.momentum_x, &grid_.momentum_r, &grid_.force_x, &grid_.force_r})
      none.store(sums->data() + n);
  }
  energy_.damping += scaling * sum(damping);
  const double transport = sum(axial_transport);
  bulk_kinetic_ = 0.5 * scaling * sum(old_transport) * transport / total_mass_;
  energy_.body_force += mean_acceleration * transport * dt;
  travel_ += scene_.frame == scene::Frame::lab ? transport / total_mass_ * dt : 0.0;
}

void Simulation::step(double dt) {
  balance_ = energy_;
  const double pressure = load_.at(time_), next_pressure = load_.at(time_ + dt);
  locate_load();
  for (const LoadShare& share : load_shares_) grid_.force_x[share.node] += pressure * share.force;
  locate_bores();
  for (const LoadShare& share : bore_shares_) grid_.force_r[share.node] += share.force;
  update_grid(dt);
  double flow = 0.0;  // of the loaded face against unit pressure, m3/s
  for (const LoadShare& share : load_shares_) flow += share.force * grid_.velocity_x[share.node];
  energy_.external += 0.5 * (pressure + next_pressure) * flow * dt;
  for (const LoadShare& share : bore_shares_)
    energy_.external += share.force * grid_.velocity_r[share.node] * dt;

  StepContext context = context_of(dt);
  grid_.origin_x = window_origin();
  context.write_origin = grid_.origin_x;
  StepTotals totals;
  for (SteelBody& body : steel_) advance(body, scene_.steel, grid_, context, totals);
  for (ChargeBody& body : charges_) advance(body, scene_.charge, grid_, context, totals);
  // The motion of the mass centre takes its energy from the external work to the last digit and says nothing
  // of the computation; in the lab frame it would drown what does.
  balance_.kinetic = scene_.numerics.inertial_scaling * sum(totals.centred_kinetic) - bulk_kinetic_;
  balance_.external -= bulk_kinetic_;
  energy_.internal += sum(totals.internal);
  energy_.plastic += sum(totals.plastic);
  energy_.viscous += sum(totals.viscous);
  energy_.crack += sum(totals.crack);
  energy_.damping += scene_.numerics.inertial_scaling * sum(totals.pic_loss);
  events_.tension_cutoff += sum(totals.tension_cutoff);
  events_.hugoniot_guard += sum(totals.hugoniot_guard);
  events_.crack_at_bound += sum(totals.crack_at_bound);
  events_.off_grid += sum(totals.off_grid);
  time_ += dt;
}

double Simulation::kinetic_energy() const {
  double total = 0.0;
  for_each_body([&](const Kinematics& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i)
      total += 0.5 * p.mass[i] * (p.velocity_x[i] * p.velocity_x[i] + p.velocity_r[i] * p.velocity_r[i]);
  });
  return scene_.numerics.inertial_scaling * total;
}

double Simulation::axial_momentum() const {
  double total = 0.0;
  for_each_body([&](const Kinematics& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i) total += p.mass[i] * p.velocity_x[i];
  });
  return total;
}

}  // namespace launchsafe::mpm
