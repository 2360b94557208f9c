#include "monitor.hpp"

#include <fmt/format.h>

namespace launchsafe::run {
namespace {

double whole_shell(const mpm::Simulation& simulation) {
  return simulation.axisymmetric() ? 2.0 * std::numbers::pi : 1.0;
}

/// Place of the first particle whose position or velocity is not finite, for the message.
std::string first_broken_particle(const mpm::Simulation& simulation) {
  std::string place = "no particle found";
  bool found = false;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (int j = 0; j < p.lattice.rows() && !found; ++j)
      for (int i = 0; i < p.lattice.columns() && !found; ++i) {
        const std::size_t slot = p.lattice.slot(i, j);
        if (std::isfinite(p.velocity_x[slot] + p.velocity_r[slot] + p.pressure[slot] + p.volume_ratio[slot]))
          continue;
        found = true;
        place = fmt::format("first in body \"{}\" at x = {:.4g} cm, r = {:.4g} cm (initial place)",
                            simulation.scene().bodies[static_cast<std::size_t>(p.body)].name,
                            100.0 * p.lattice.x_of(i), 100.0 * p.lattice.r_of(j));
      }
  });
  return place;
}

double largest_of(const math::AlignedArray* values) {
  return values == nullptr || values->empty() ? 0.0 : *std::ranges::max_element(*values);
}

/// Upper bound of sum G^2/S over the nodes of one direction, 1/m2.
double stiffness(double cell, double half) { return 2.0 / (cell * half) + 1.0 / (cell * (cell - half)); }

/// The total-Lagrangian bound: weights are constants of the lattice, so the sums are known.
double proved_on_lattice(const scene::Scene& scene) {
  const bool axisymmetric = scene.symmetry == scene::Symmetry::axisymmetric;
  const int per_cell = scene.numerics.particles_per_cell;
  // sum G^2/S = (1/S0 + 1/S1)/L^2 along one direction; largest for the particle nearest to a cell's edge.
  const double nearest = 0.5 / per_cell;
  const double along_x = 1.0 / nearest + 1.0 / (1.0 - nearest);
  double along_r = along_x;
  for (const scene::Body& body : scene.bodies) {
    const std::vector<double> edges = scene::particle_edges(scene, body).r;
    for (std::size_t j = 0; axisymmetric && j + 1 < edges.size(); ++j) {
      const double inner = edges[j - j % static_cast<std::size_t>(per_cell)];
      const double r = 0.5 * (edges[j] + edges[j + 1]), length = edges[j + 1] - edges[j];
      const double outer_share = (r - inner + length * length / (12.0 * r)) / (length * per_cell);
      along_r = std::max(along_r, 1.0 / outer_share + 1.0 / (1.0 - outer_share));
    }
  }
  return 2.0 / std::sqrt(along_x + along_r);
}

}  // namespace

const math::AlignedArray* field_of(const mpm::AnyBody& any, std::string_view name) {
  return std::visit(
      [&]<class Law>(const mpm::Body<Law>& body) -> const math::AlignedArray* {
        const std::size_t field = materials::field_index<Law>(name);
        return field < body.state.size() ? &body.state[field] : nullptr;
      },
      any);
}

EnergyBalance energy_of(const mpm::Simulation& simulation) {
  const double whole = whole_shell(simulation);
  const mpm::EnergyTotals& totals = simulation.energy();
  EnergyBalance balance{totals.kinetic, totals.internal, totals.external, totals.body_force,
                        totals.damping, totals.contact,  totals.plastic,  totals.viscous,
                        totals.crack,   totals.hourglass};
  for (const auto& term : energy_terms) balance.*term.member *= whole;
  return balance;
}

MonitorSample monitor_sample(const mpm::Simulation& simulation, double time_step) {
  MonitorSample sample{.time = simulation.time(), .time_step = time_step, .energy = energy_of(simulation)};
  for (const mpm::AnyBody& body : simulation.bodies()) {
    sample.largest_plastic_strain =
        std::max(sample.largest_plastic_strain, largest_of(field_of(body, "plastic_strain")));
    sample.largest_crack_radius =
        std::max(sample.largest_crack_radius, largest_of(field_of(body, "crack_radius")));
  }
  sample.momentum = whole_shell(simulation) * simulation.axial_momentum();
  return sample;
}

std::vector<InterfaceResult> interfaces_of(const mpm::Simulation& simulation) {
  std::vector<InterfaceResult> results;
  const mpm::TotalLagrangian* form = simulation.total_lagrangian();
  if (form == nullptr) return results;
  const mpm::Contact& contact = form->contact();
  for (std::size_t face = 0; face < contact.faces(); ++face) {
    InterfaceResult result;
    result.body = simulation.scene().interfaces[contact.interface_of(face)].body;
    result.along_x = contact.is_along_x(face);
    result.face = contact.face_at(face);
    result.friction_work = whole_shell(simulation) * contact.friction_work(face);
    for (const mpm::FaceState& node : contact.state_of(face)) {
      result.place.push_back(node.place);
      result.friction_heat.push_back(node.friction_heat);
      result.slid.push_back(node.slid);
      result.largest_gap.push_back(node.largest_gap);
      result.overlap.push_back(node.overlap);
    }
    results.push_back(std::move(result));
  }
  return results;
}

LimiterCounts count_limited(const mpm::Simulation& simulation) {
  const mpm::EventCounts& events = simulation.events();
  return {static_cast<std::uint64_t>(events.crack_at_bound),
          static_cast<std::uint64_t>(events.tension_cutoff),
          static_cast<std::uint64_t>(events.pressure_guard)};
}

std::optional<Stop> reason_to_stop(const mpm::Simulation& simulation, const EnergyBalance& energy,
                                   double largest_energy, double drift_limit) {
  if (simulation.events().off_grid > 0.0)
    return Stop{RunStatus::particles_left_grid,
                fmt::format("particles left the grid ({:.0f} particle-steps)", simulation.events().off_grid)};
  if (simulation.events().distorted > 0.0)
    return Stop{
        RunStatus::cells_distorted,
        fmt::format("cells are inverted or stretched beyond what strains mean ({:.0f} particle-steps)",
                    simulation.events().distorted)};
  if (!std::isfinite(energy.kinetic + energy.internal + energy.external))
    return Stop{RunStatus::non_finite,
                "the computation is no longer finite, " + first_broken_particle(simulation)};
  const double drift = energy.drift() * energy.scale() / largest_energy;
  if (std::abs(drift) > drift_limit)
    return Stop{RunStatus::energy_drift,
                fmt::format("energy drift {:.3g} % of {:.4g} J is past the limit {:.3g} %", 100.0 * drift,
                            largest_energy, 100.0 * drift_limit)};
  return std::nullopt;
}

double proved_time_step_factor(const scene::Scene& scene) {
  if (scene.numerics.formulation == scene::Formulation::total_lagrangian) return proved_on_lattice(scene);
  const scene::Mesh mesh = scene::fit_mesh(scene);
  double least = math::infinity;
  for (const scene::Body& body : scene.bodies) {
    const scene::ParticleCount count = scene::particles_of(scene, body);
    const double half_x = 0.5 * (body.x_end - body.x_begin) / count.nx;
    const double half_r = 0.5 * (body.r_end - body.r_begin) / count.nr;
    const double fastest = std::sqrt(stiffness(mesh.dx, half_x) + stiffness(mesh.dr, half_r));
    least = std::min(least, 2.0 / (fastest * std::min(mesh.dx, mesh.dr)));
  }
  return least;
}

std::string step_remark(const scene::Scene& scene) {
  const double factor = scene.numerics.time_step_factor, proved = proved_time_step_factor(scene);
  if (!(factor > proved)) return {};
  return fmt::format(
      "; the time step factor {:.3g} is above {:.3g}, up to which steps are proved stable for these "
      "particles",
      factor, proved);
}

}  // namespace launchsafe::run
