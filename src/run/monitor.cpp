#include "monitor.hpp"

#include "launchsafe/run/stable_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

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

/// A state field of a body by name; null where its law has none of that name.
const math::AlignedArray* field_of(const mpm::AnyBody& any, std::string_view name) {
  return std::visit(
      [&]<class Law>(const mpm::Body<Law>& body) -> const math::AlignedArray* {
        const std::size_t field = materials::field_index<Law>(name);
        return field < body.state.size() ? &body.state[field] : nullptr;
      },
      any);
}

/// Present over initial distance between the neighbours of place `i` on a line of `count` particles, at an
/// end between the particle and its one neighbour; 1 for a particle without any. `now` and `at_rest` give
/// places.
template <class Now, class AtRest>
double stretch_at(int i, int count, Now now, AtRest at_rest) {
  const int before = std::max(i - 1, 0), behind = std::min(i + 1, count - 1);
  return before == behind ? 1.0 : (now(behind) - now(before)) / (at_rest(behind) - at_rest(before));
}

/// The half lengths of the cells of a body's particles, in the order of a snapshot.
void add_half_lengths(const mpm::ParticleFields& p, Snapshot& shot) {
  const mpm::Lattice& lattice = p.lattice;
  for (int j = 0; j < lattice.rows(); ++j)
    for (int i = 0; i < lattice.columns(); ++i) {
      const double stretch_x = stretch_at(
          i, lattice.columns(), [&](int k) { return p.x[lattice.slot(k, j)]; },
          [&](int k) { return lattice.x_of(k); });
      const double stretch_r = stretch_at(
          j, lattice.rows(), [&](int k) { return p.r[lattice.slot(i, k)]; },
          [&](int k) { return lattice.r_of(k); });
      shot.half_length_x.push_back(0.5 * lattice.length_x(i) * stretch_x);
      shot.half_length_r.push_back(0.5 * lattice.length_r(j) * stretch_r);
    }
}

/// The burnt shares of all particles, in the order of a snapshot; none where nothing burns.
std::vector<double> burnt_shares(const mpm::Simulation& simulation) {
  std::vector<double> shares;
  bool burns = false;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (int j = 0; j < p.lattice.rows(); ++j)
      for (int i = 0; i < p.lattice.columns(); ++i) {
        const mpm::BurningParticle* burning = p.burning ? p.burning->find(p.lattice.slot(i, j)) : nullptr;
        shares.push_back(burning != nullptr ? burning->state.burnt_share : 0.0);
        burns = burns || burning != nullptr;
      }
  });
  return burns ? shares : std::vector<double>{};
}

double largest_of(const math::AlignedArray* values) {
  return values == nullptr || values->empty() ? 0.0 : *std::max_element(values->begin(), values->end());
}

}  // namespace

EnergyBalance energy_of(const mpm::Simulation& simulation) {
  const double whole = whole_shell(simulation);
  const mpm::EnergyTotals& totals = simulation.energy();
  EnergyBalance energy;
  energy.kinetic = whole * totals.kinetic;
  energy.internal = whole * totals.internal;
  energy.external = whole * totals.external;
  energy.body_force = whole * totals.body_force;
  energy.damping = whole * totals.damping;
  energy.contact = whole * totals.contact;
  energy.hourglass = whole * totals.hourglass;
  energy.plastic = whole * totals.plastic;
  energy.viscous = whole * totals.viscous;
  energy.crack = whole * totals.crack;
  return energy;
}

MonitorSample monitor_sample(const mpm::Simulation& simulation, double time_step) {
  MonitorSample sample;
  sample.time = simulation.time();
  sample.time_step = time_step;
  sample.energy = energy_of(simulation);
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
      result.bonded.push_back(node.bonded ? 1.0 : 0.0);
    }
    results.push_back(std::move(result));
  }
  return results;
}

Snapshot take_snapshot(const mpm::Simulation& simulation) {
  Snapshot shot;
  shot.time = simulation.time();
  const auto value = [](const math::AlignedArray* field, std::size_t slot) {
    return field == nullptr ? 0.0 : (*field)[slot];
  };
  for (const mpm::AnyBody& any : simulation.bodies()) {
    const mpm::ParticleFields& p = mpm::particle_fields_of(any);
    const math::AlignedArray *crack = field_of(any, "crack_radius"),
                             *plastic = field_of(any, "plastic_strain");
    const double density = std::visit([](const auto& body) { return body.law.initial_density(); }, any);
    for (int j = 0; j < p.lattice.rows(); ++j)
      for (int i = 0; i < p.lattice.columns(); ++i) {
        const std::size_t slot = p.lattice.slot(i, j);
        shot.x.push_back(p.x[slot]);
        shot.r.push_back(p.r[slot]);
        shot.velocity_x.push_back(p.velocity_x[slot]);
        shot.velocity_r.push_back(p.velocity_r[slot]);
        shot.density.push_back(density / p.volume_ratio[slot]);
        shot.pressure.push_back(p.pressure[slot]);
        shot.temperature.push_back(p.temperature[slot]);
        const auto deviator = std::visit([&](const auto& body) { return body.deviator(slot); }, any);
        shot.von_mises.push_back(math::von_mises(deviator));
        shot.deviator_rr.push_back(deviator.rr);
        shot.deviator_xx.push_back(deviator.xx);
        shot.deviator_rx.push_back(deviator.rx);
        shot.crack_radius.push_back(value(crack, slot));
        shot.plastic_strain.push_back(value(plastic, slot));
        shot.body.push_back(p.body);
      }
    add_half_lengths(p, shot);
  }
  shot.burnt_share = burnt_shares(simulation);
  return shot;
}

LimiterCounts count_limited(const mpm::Simulation& simulation) {
  const mpm::EventCounts& events = simulation.events();
  LimiterCounts counts;
  counts.crack_at_bound = static_cast<std::uint64_t>(events.crack_at_bound);
  counts.tension_cutoff = static_cast<std::uint64_t>(events.tension_cutoff);
  counts.hugoniot_guard = static_cast<std::uint64_t>(events.pressure_guard);
  return counts;
}

std::optional<Stop> reason_to_stop(const mpm::Simulation& simulation, const EnergyBalance& energy,
                                   double largest_energy, double drift_limit) {
  const std::string when = fmt::format("at t = {:.6g} ms", 1e3 * simulation.time());
  const auto stop = [&](RunStatus status, const std::string& what) {
    return Stop{status, when + ": " + what + step_remark(simulation.scene())};
  };
  if (simulation.events().off_grid > 0.0)
    return stop(RunStatus::particles_left_grid,
                fmt::format("particles left the grid ({:.0f} particle-steps)", simulation.events().off_grid));
  if (simulation.events().distorted > 0.0)
    return stop(
        RunStatus::cells_distorted,
        fmt::format("cells are inverted or stretched beyond what strains mean ({:.0f} particle-steps)",
                    simulation.events().distorted));
  if (!std::isfinite(energy.kinetic + energy.internal + energy.external))
    return stop(RunStatus::non_finite,
                "the computation is no longer finite, " + first_broken_particle(simulation));
  const double drift = energy.drift() * energy.scale() / largest_energy;
  if (std::abs(drift) > drift_limit)
    return stop(RunStatus::energy_drift,
                fmt::format("energy drift {:.3g} % of {:.4g} J is past the limit {:.3g} %", 100.0 * drift,
                            largest_energy, 100.0 * drift_limit));
  return std::nullopt;
}

}  // namespace launchsafe::run
