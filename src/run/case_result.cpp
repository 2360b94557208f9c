#include "launchsafe/run/case_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace launchsafe::run {

std::string to_string(RunStatus status) {
  // In the order of RunStatus.
  constexpr std::array words{
      "completed",   "non-finite", "energy drift",    "time step collapse",     "particles left the grid",
      "interrupted", "timed out",  "cells distorted", "outside of the gas law", "flame beyond sound"};
  static_assert(words.size() == static_cast<std::size_t>(last_status) + 1);
  return words.at(static_cast<std::size_t>(status));
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
