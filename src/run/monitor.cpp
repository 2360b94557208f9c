#include "monitor.hpp"

#include <fmt/format.h>

#include <set>

namespace launchsafe::run {
namespace {

constexpr double whole_circle = 2.0 * std::numbers::pi;

double largest_of(const math::AlignedArray* values) {
  return values == nullptr || values->empty() ? 0.0 : *std::ranges::max_element(*values);
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
  EnergyBalance balance = simulation.energy();
  for (const auto& term : energy_terms) balance.*term.member *= whole_circle;
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
  sample.momentum = whole_circle * simulation.axial_momentum();
  return sample;
}

std::vector<InterfaceResult> interfaces_of(const mpm::Simulation& simulation) {
  std::vector<InterfaceResult> results;
  const mpm::TotalLagrangian* form = simulation.total_lagrangian();
  if (form == nullptr) return results;
  const mpm::Contact& contact = form->contact();
  for (std::size_t face = 0; face < contact.faces(); ++face) {
    InterfaceResult& result = results.emplace_back(
        InterfaceResult{.body = simulation.scene().interfaces[contact.interface_of(face)].body});
    for (const mpm::FaceState& node : contact.state_of(face, form->nodes()))
      result.overlap = std::max(result.overlap, node.overlap);
  }
  return results;
}

double yielded_wall(const mpm::Simulation& simulation) {
  const scene::Extent charge = scene::charge_extent(simulation.scene());
  const double touching = scene::length_tolerance(simulation.scene());
  std::set<std::pair<double, double>> yielded;  // columns of particles: where they begin and end
  for (const mpm::Body<materials::Steel>& steel : simulation.bodies_of<materials::Steel>()) {
    const mpm::Lattice& l = steel.particles.lattice;
    if (l.x_begin() >= charge.x_end - touching || l.x_end() <= charge.x_begin + touching) continue;
    for (int i = 0; i < l.columns(); ++i)
      for (int j = 0; j < l.rows(); ++j)
        if (steel[materials::Steel::plastic_strain][l.slot(i, j)] > yield_of_wall)
          yielded.emplace(l.x_of(i) - 0.5 * l.length_x(i), l.x_of(i) + 0.5 * l.length_x(i));
  }
  double length = 0.0, counted = -std::numeric_limits<double>::infinity();
  for (const auto& [begin, end] : yielded) {
    length += std::max(0.0, end - std::max(begin, counted));
    counted = std::max(counted, end);
  }
  return length;
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
    return Stop{RunStatus::non_finite, "the computation is no longer finite"};
  const double drift = energy.drift() * energy.scale() / largest_energy;
  if (std::abs(drift) > drift_limit)
    return Stop{RunStatus::energy_drift,
                fmt::format("energy drift {:.3g} % of {:.4g} J is past the limit {:.3g} %", 100.0 * drift,
                            largest_energy, 100.0 * drift_limit)};
  return std::nullopt;
}

}  // namespace launchsafe::run
