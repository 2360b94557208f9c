#include "launchsafe/run/case_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::run {

std::string to_string(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::non_finite:
      return "non-finite";
    case RunStatus::energy_drift:
      return "energy drift";
    case RunStatus::time_step_collapse:
      return "time step collapse";
    case RunStatus::particles_left_grid:
      return "particles left the grid";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::timed_out:
      return "timed out";
    case RunStatus::cells_distorted:
      return "cells distorted";
    case RunStatus::outside_gas_law:
      return "outside of the gas law";
    case RunStatus::flame_beyond_sound:
      return "flame beyond sound";
  }
  return "unknown";
}

std::string to_string(const LimiterCounts& limiters) {
  std::string text;
  const auto add = [&text](const char* name, std::uint64_t count) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
  };
  add("crack bound", limiters.crack_at_bound);
  add("tension cut-off", limiters.tension_cutoff);
  add("Hugoniot guard", limiters.hugoniot_guard);
  return text;
}

double EnergyBalance::scale() const {
  return std::max({std::abs(kinetic) + std::abs(internal) + std::abs(damping) + std::abs(contact),
                   std::abs(external) + std::abs(body_force), 1e-300});
}

double EnergyBalance::drift() const {
  return (kinetic + internal + damping + contact - external - body_force) / scale();
}

void add_mass(std::vector<MaterialMass>& masses, const std::string& material, double mass) {
  for (MaterialMass& each : masses)
    if (each.material == material) {
      each.mass += mass;
      return;
    }
  masses.push_back({material, mass});
}

double mass_of(const MechanicsResult& mechanics, std::string_view material) {
  for (const MaterialMass& each : mechanics.masses)
    if (each.material == material) return each.mass;
  return 0.0;
}

namespace {

/// The largest of a value of nodes on the end of the charge at `bottom` (m); NaN where one is.
double largest_at_bottom(const MechanicsResult& mechanics, double bottom,
                         std::vector<double> InterfaceResult::*values) {
  constexpr double touching = 1e-9;  // m
  double most = 0.0;
  for (const InterfaceResult& faces : mechanics.interfaces) {
    if (faces.along_x || std::abs(faces.face - bottom) > touching) continue;
    for (const double value : faces.*values) {
      if (std::isnan(value)) return value;
      most = std::max(most, value);
    }
  }
  return most;
}

}  // namespace

double friction_heat_at_bottom(const MechanicsResult& mechanics, double bottom) {
  return largest_at_bottom(mechanics, bottom, &InterfaceResult::friction_heat);
}

double opening_at_bottom(const MechanicsResult& mechanics, double bottom) {
  return largest_at_bottom(mechanics, bottom, &InterfaceResult::largest_gap);
}

double largest_energy_drift(const MechanicsResult& mechanics) {
  double largest = std::numeric_limits<double>::quiet_NaN(), scale = 0;
  for (const MonitorSample& sample : mechanics.monitor) scale = std::max(scale, sample.energy.scale());
  for (const MonitorSample& sample : mechanics.monitor) {
    const double drift = std::abs(sample.energy.drift()) * sample.energy.scale() / scale;
    if (!(drift <= largest)) largest = drift;
  }
  return largest;
}

}  // namespace launchsafe::run
