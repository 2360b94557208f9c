// What every completed launch must fulfil.
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/run/judged_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using run::MechanicsResult, run::MonitorSample;
using Violations = std::vector<std::string>;

/// Of the sum over the particles, which round-off alone separates from the bodies' mass.
constexpr double mass_share = 1e-12;
/// Of the load's whole impulse.
constexpr double momentum_share = 1e-6;
/// By so much of the largest energy may a sum that never falls seem to: round-off of sums over particles.
constexpr double dissipation_share = 1e-9;
/// K, of the skin's integration.
constexpr double temperature_slack = 1e-3;

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool is_finite(const MonitorSample& sample) {
  const run::EnergyBalance& e = sample.energy;
  return std::isfinite(sample.time + sample.time_step + sample.momentum + sample.largest_crack_radius +
                       sample.largest_plastic_strain) &&
         std::isfinite(e.kinetic + e.internal + e.external + e.body_force + e.damping + e.contact +
                       e.plastic + e.viscous + e.crack);
}

void check_finite(const MechanicsResult& mechanics, Violations& violations) {
  const trace::BottomTrace& trace = mechanics.trace;
  bool finite = trace.samples() > 0;
  for (const auto* values : {&trace.time, &trace.chamber_pressure, &trace.bottom_pressure,
                             &trace.mean_chamber_pressure, &trace.mean_bottom_pressure})
    finite = finite && all_finite(*values);
  for (const auto& friction : trace.friction) finite = finite && all_finite(friction);
  if (!finite) violations.emplace_back("the bottom trace is empty or not finite");
  if (!std::all_of(mechanics.monitor.begin(), mechanics.monitor.end(),
                   [](const MonitorSample& sample) { return is_finite(sample); }))
    violations.emplace_back("the monitor history is not finite");
}

void check_masses(const scene::Scene& scene, const MechanicsResult& mechanics, Violations& violations) {
  for (const scene::Material& material : scene::used_materials(scene)) {
    const double exact = scene::mass_of(scene, material.name);
    const double error = std::abs(mass_of(mechanics, material.name) - exact);
    if (error <= mass_share * exact) continue;
    violations.push_back(
        fmt::format("the particles' mass of {} is off by {:.2g} of it", material.name, error / exact));
  }
}

/// Impulse of the load until a time, N s, and how far sums over single steps may be off it: they take the
/// pressure at the begin of every step.
struct Impulse {
  double value = 0, error = 0;
};
Impulse impulse_until(const scene::Scene& scene, double time, double longest_step) {
  constexpr int parts = 20000;
  const scene::PressureHistory load(scene.load);
  const double area = scene::base_area(scene), dt = time / parts;
  Impulse impulse;
  double variation = 0;
  for (int i = 0; i < parts; ++i) {
    const double begin = load.at(i * dt), end = load.at((i + 1) * dt);
    impulse.value += 0.5 * (begin + end) * dt * area;
    variation += std::abs(end - begin);
  }
  impulse.error = variation * (longest_step + dt) * area;
  return impulse;
}

/// The load pushes toward the nose, against x.
void check_momentum(const scene::Scene& scene, const MechanicsResult& mechanics, Violations& violations) {
  if (mechanics.monitor.empty()) return;
  double longest_step = 0;
  for (const MonitorSample& sample : mechanics.monitor)
    longest_step = std::max(longest_step, sample.time_step);
  const Impulse impulse = impulse_until(scene, mechanics.end_time, longest_step);
  if (scene.frame == scene::Frame::lab) {
    const double off = mechanics.monitor.back().momentum + impulse.value;
    if (std::abs(off) <= momentum_share * impulse.value + impulse.error) return;
    violations.push_back(
        fmt::format("the momentum is {:.3g} kg m/s off the load's impulse, {:.4g} N s", off, impulse.value));
    return;
  }
  double largest = 0;
  for (const MonitorSample& sample : mechanics.monitor)
    if (!(std::abs(sample.momentum) <= largest)) largest = std::abs(sample.momentum);
  const double scale = std::max(impulse.value + impulse.error, run::least_judged_impulse(scene));
  if (largest <= momentum_share * scale) return;
  violations.push_back(
      fmt::format("the momentum relative to the co-moving frame reaches {:.3g} kg m/s; the load's impulse is "
                  "{:.4g} N s",
                  largest, impulse.value));
}

/// Against the largest energy of the run, or the least one that balances are judged on.
void check_energy(const scene::Scene& scene, const MechanicsResult& mechanics, Violations& violations) {
  double scale = run::least_judged_energy(scene), drift = 0;
  for (const MonitorSample& sample : mechanics.monitor) {
    scale = std::max(scale, sample.energy.scale());
    drift = std::max(drift, std::abs(sample.energy.drift()) * sample.energy.scale());
  }
  const double limit = scene.numerics.energy_drift_limit;
  if (drift <= limit * scale) return;
  violations.push_back(
      fmt::format("the energy drifts by {:.3g} %, more than {:.3g} %", 100.0 * drift / scale, 100.0 * limit));
}

void check_dissipation(const MechanicsResult& mechanics, Violations& violations) {
  double scale = 0;
  for (const MonitorSample& sample : mechanics.monitor) scale = std::max(scale, sample.energy.scale());
  const auto check = [&](const char* name, double run::EnergyBalance::*part) {
    for (std::size_t i = 1; i < mechanics.monitor.size(); ++i) {
      const double change = mechanics.monitor[i].energy.*part - mechanics.monitor[i - 1].energy.*part;
      if (change >= -dissipation_share * scale) continue;
      violations.push_back(fmt::format("{} dissipation falls by {:.3g} J at {:.4g} ms", name, -change,
                                       1e3 * mechanics.monitor[i].time));
      return;
    }
  };
  check("plastic", &run::EnergyBalance::plastic);
  check("viscous", &run::EnergyBalance::viscous);
  check("crack", &run::EnergyBalance::crack);
}

void check_friction(const trace::BottomTrace& trace, Violations& violations) {
  const std::size_t stations = trace.stations.size();
  for (const auto& friction : trace.friction) {
    for (std::size_t i = stations; stations > 0 && i < friction.size(); ++i) {
      if (friction[i] >= friction[i - stations]) continue;
      violations.push_back(
          fmt::format("friction heat falls at station {}", trace.stations[i % stations].name));
      return;
    }
  }
}

void check_temperatures(const scene::Scene& scene, const trace::BottomTrace& trace,
                        const std::vector<double>& gaps, Violations& violations) {
  if (trace.samples() == 0) return;
  const surface::SkinModel model = surface::skin_model(scene);
  const double coldest = std::min(scene.initial_temperature, scene.surface.air.initial_temperature);
  for (const double gap : gaps) {
    const surface::SkinHistory skin = surface::integrate_skin(model, trace, gap);
    const auto lowest = std::min_element(skin.temperature.begin(), skin.temperature.end());
    if (lowest == skin.temperature.end() || !(*lowest < coldest - temperature_slack)) continue;
    violations.push_back(fmt::format("the skin falls to {:.5g} K, below {:.5g} K at first, at {:.6g} cm",
                                     *lowest, coldest, 100.0 * gap));
  }
}

}  // namespace

std::vector<std::string> violations_of(const scene::Scene& scene, const MechanicsResult& mechanics,
                                       const std::vector<double>& gaps) {
  Violations violations;
  check_finite(mechanics, violations);
  check_masses(scene, mechanics, violations);
  check_momentum(scene, mechanics, violations);
  check_energy(scene, mechanics, violations);
  check_dissipation(mechanics, violations);
  check_friction(mechanics.trace, violations);
  check_temperatures(scene, mechanics.trace, gaps, violations);
  return violations;
}

}  // namespace launchsafe::kinds
