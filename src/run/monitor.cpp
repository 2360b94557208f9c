#include "monitor.hpp"

#include "launchsafe/run/stable_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace launchsafe::run {
namespace {

double whole_shell(const mpm::Simulation& simulation) {
  return simulation.axisymmetric() ? 2.0 * std::numbers::pi : 1.0;
}

/// Place of the first particle whose position or velocity is not finite, for the message.
std::string first_broken_particle(const mpm::Simulation& simulation) {
  std::string place = "no particle found";
  bool found = false;
  simulation.for_each_body([&](const mpm::Kinematics& p) {
    for (int j = 0; j < p.lattice.rows && !found; ++j)
      for (int i = 0; i < p.lattice.columns && !found; ++i) {
        const std::size_t slot = p.lattice.slot(i, j);
        if (std::isfinite(p.velocity_x[slot] + p.velocity_r[slot] + p.pressure[slot] + p.density[slot]))
          continue;
        found = true;
        place = fmt::format("first in body \"{}\" at x = {:.4g} cm, r = {:.4g} cm (initial place)",
                            simulation.scene().bodies[static_cast<std::size_t>(p.body)].name,
                            100.0 * p.lattice.x_of(i), 100.0 * p.lattice.r_of(j));
      }
  });
  return place;
}

double largest_of(const math::AlignedArray& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
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
  for (const mpm::SteelBody& body : simulation.steel())
    sample.largest_plastic_strain = std::max(sample.largest_plastic_strain, largest_of(body.plastic_strain));
  for (const mpm::ChargeBody& body : simulation.charges())
    sample.largest_crack_radius = std::max(sample.largest_crack_radius, largest_of(body.crack_radius));
  sample.momentum = whole_shell(simulation) * simulation.axial_momentum();
  return sample;
}

Snapshot take_snapshot(const mpm::Simulation& simulation) {
  Snapshot shot;
  shot.time = simulation.time();
  const auto add = [&](const mpm::Kinematics& p, auto&& von_mises, auto&& crack, auto&& plastic) {
    for (int j = 0; j < p.lattice.rows; ++j)
      for (int i = 0; i < p.lattice.columns; ++i) {
        const std::size_t slot = p.lattice.slot(i, j);
        shot.x.push_back(p.x[slot]);
        shot.r.push_back(p.r[slot]);
        shot.velocity_x.push_back(p.velocity_x[slot]);
        shot.velocity_r.push_back(p.velocity_r[slot]);
        shot.density.push_back(p.density[slot]);
        shot.pressure.push_back(p.pressure[slot]);
        shot.temperature.push_back(p.temperature[slot]);
        shot.von_mises.push_back(von_mises(slot));
        shot.crack_radius.push_back(crack(slot));
        shot.plastic_strain.push_back(plastic(slot));
        shot.body.push_back(p.body);
      }
  };
  const auto none = [](std::size_t) { return 0.0; };
  for (const mpm::SteelBody& b : simulation.steel())
    add(
        b.kinematics,
        [&](std::size_t s) {
          return math::von_mises(math::Deviator<double>{b.stress_rr[s], b.stress_xx[s], b.stress_rx[s]});
        },
        none, [&](std::size_t s) { return b.plastic_strain[s]; });
  for (const mpm::ChargeBody& b : simulation.charges())
    add(
        b.kinematics, [&](std::size_t s) { return math::von_mises(mpm::deviator(b, s)); },
        [&](std::size_t s) { return b.crack_radius[s]; }, none);
  return shot;
}

LimiterCounts count_limited(const mpm::Simulation& simulation) {
  const mpm::EventCounts& events = simulation.events();
  LimiterCounts counts;
  counts.crack_at_bound = static_cast<std::uint64_t>(events.crack_at_bound);
  counts.tension_cutoff = static_cast<std::uint64_t>(events.tension_cutoff);
  counts.hugoniot_guard = static_cast<std::uint64_t>(events.hugoniot_guard);
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
