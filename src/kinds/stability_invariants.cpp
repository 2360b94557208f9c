// What every stress case that completed must fulfil.
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/materials/product_gas.hpp"
#include "launchsafe/run/judged_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {
namespace {

using materials::ProductGas;
using run::CombustionHistory, run::MechanicsResult, run::MonitorSample;
using Violations = std::vector<std::string>;

/// Of the sum over the particles, which round-off alone separates from the bodies' mass.
constexpr double mass_share = 1e-12;
/// Of the load's whole impulse.
constexpr double momentum_share = 1e-6;
/// By so much of the largest energy may a sum that never falls seem to: round-off of sums over particles.
constexpr double dissipation_share = 1e-9;
/// K, of the skin's integration.
constexpr double temperature_slack = 1e-3;
/// Of the heat of reaction of what burnt, that may be made or lost.
constexpr double energy_share = 0.01;
/// Of masses and heats that burn, which are sums over particles.
constexpr double sum_share = 1e-9;

bool all_finite(std::initializer_list<const std::vector<double>*> all) {
  return std::all_of(all.begin(), all.end(), [](const std::vector<double>* values) {
    return std::all_of(values->begin(), values->end(), [](double value) { return std::isfinite(value); });
  });
}

bool is_finite(const MonitorSample& sample) {
  const run::EnergyBalance& e = sample.energy;
  return std::isfinite(sample.time + sample.time_step + sample.momentum + sample.largest_crack_radius +
                       sample.largest_plastic_strain) &&
         std::isfinite(e.kinetic + e.internal + e.external + e.body_force + e.damping + e.contact +
                       e.plastic + e.viscous + e.crack);
}

// --- of a launch ---

void check_finite(const CompletedRun& run, Violations& violations) {
  const trace::BottomTrace& trace = run.mechanics.trace;
  bool finite =
      trace.samples() > 0 && all_finite({&trace.time, &trace.chamber_pressure, &trace.bottom_pressure,
                                         &trace.mean_chamber_pressure, &trace.mean_bottom_pressure});
  for (const auto& friction : trace.friction) finite = finite && all_finite({&friction});
  if (!finite) violations.emplace_back("the bottom trace is empty or not finite");
  if (!std::all_of(run.mechanics.monitor.begin(), run.mechanics.monitor.end(), is_finite))
    violations.emplace_back("the monitor history is not finite");
}

void check_masses(const CompletedRun& run, Violations& violations) {
  for (const scene::Material& material : scene::used_materials(run.scene)) {
    const double exact = scene::mass_of(run.scene, material.name);
    const double error = std::abs(mass_of(run.mechanics, material.name) - exact);
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
void check_momentum(const CompletedRun& run, Violations& violations) {
  const std::vector<MonitorSample>& monitor = run.mechanics.monitor;
  if (monitor.empty()) return;
  double longest_step = 0;
  for (const MonitorSample& sample : monitor) longest_step = std::max(longest_step, sample.time_step);
  const Impulse impulse = impulse_until(run.scene, run.mechanics.end_time, longest_step);
  if (run.scene.frame == scene::Frame::lab) {
    const double off = monitor.back().momentum + impulse.value;
    if (std::abs(off) <= momentum_share * impulse.value + impulse.error) return;
    violations.push_back(
        fmt::format("the momentum is {:.3g} kg m/s off the load's impulse, {:.4g} N s", off, impulse.value));
    return;
  }
  double largest = 0;
  for (const MonitorSample& sample : monitor)
    if (!(std::abs(sample.momentum) <= largest)) largest = std::abs(sample.momentum);
  const double scale = std::max(impulse.value + impulse.error, run::least_judged_impulse(run.scene));
  if (largest <= momentum_share * scale) return;
  violations.push_back(
      fmt::format("the momentum relative to the co-moving frame reaches {:.3g} kg m/s; the load's impulse is "
                  "{:.4g} N s",
                  largest, impulse.value));
}

void add_drift(const CompletedRun& run, double drift, Violations& violations) {
  const double limit = run.scene.numerics.energy_drift_limit;
  if (!(drift <= limit))
    violations.push_back(
        fmt::format("the energy drifts by {:.3g} %, more than {:.3g} %", 100.0 * drift, 100.0 * limit));
}

/// Against the largest energy of the run, or the least one that balances are judged on.
void check_energy(const CompletedRun& run, Violations& violations) {
  double scale = run::least_judged_energy(run.scene), drift = 0;
  for (const MonitorSample& sample : run.mechanics.monitor) {
    scale = std::max(scale, sample.energy.scale());
    drift = std::max(drift, std::abs(sample.energy.drift()) * sample.energy.scale());
  }
  add_drift(run, drift / scale, violations);
}

void check_dissipation(const CompletedRun& run, Violations& violations) {
  const std::vector<MonitorSample>& monitor = run.mechanics.monitor;
  double scale = 0;
  for (const MonitorSample& sample : monitor) scale = std::max(scale, sample.energy.scale());
  const auto check = [&](const char* name, double run::EnergyBalance::*part) {
    for (std::size_t i = 1; i < monitor.size(); ++i) {
      const double change = monitor[i].energy.*part - monitor[i - 1].energy.*part;
      if (change >= -dissipation_share * scale) continue;
      violations.push_back(
          fmt::format("{} dissipation falls by {:.3g} J at {:.4g} ms", name, -change, 1e3 * monitor[i].time));
      return;
    }
  };
  check("plastic", &run::EnergyBalance::plastic);
  check("viscous", &run::EnergyBalance::viscous);
  check("crack", &run::EnergyBalance::crack);
}

void check_friction(const CompletedRun& run, Violations& violations) {
  const trace::BottomTrace& trace = run.mechanics.trace;
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

void check_skin(const CompletedRun& run, Violations& violations) {
  const trace::BottomTrace& trace = run.mechanics.trace;
  if (trace.samples() == 0) return;
  const surface::SkinModel model = surface::skin_model(run.scene);
  const double coldest = std::min(run.scene.initial_temperature, run.scene.surface.air.initial_temperature);
  for (const double gap : run.gaps) {
    const surface::SkinHistory skin = surface::integrate_skin(model, trace, gap);
    const auto lowest = std::min_element(skin.temperature.begin(), skin.temperature.end());
    if (lowest == skin.temperature.end() || !(*lowest < coldest - temperature_slack)) continue;
    violations.push_back(fmt::format("the skin falls to {:.5g} K, below {:.5g} K at first, at {:.6g} cm",
                                     *lowest, coldest, 100.0 * gap));
  }
}

// --- of what burnt ---

void check_finite_burn(const CompletedRun& run, Violations& violations) {
  const CombustionHistory& c = *run.combustion;
  if (!all_finite({&c.time, &c.burnt_mass, &c.burnt_depth, &c.gas_volume, &c.gas_temperature, &c.pressure,
                   &c.released, &c.kept_back, &c.brought, &c.reaction_degree}) ||
      !std::isfinite(c.skin_flame_speed + c.bulk_flame_speed))
    violations.emplace_back("the history of the combustion is not finite");
}

void check_burnt_mass(const CompletedRun& run, Violations& violations) {
  const std::vector<double>& burnt = run.combustion->burnt_mass;
  double charge = 0;
  for (const scene::Material& material : scene::used_materials(run.scene))
    if (std::holds_alternative<materials::Charge>(material.law))
      charge += mass_of(run.mechanics, material.name);
  if (!(burnt.back() <= (1.0 + sum_share) * charge))
    violations.push_back(fmt::format("{:.6g} kg burnt of a charge of {:.6g} kg", burnt.back(), charge));
  if (!std::is_sorted(burnt.begin(), burnt.end())) violations.emplace_back("the burnt mass falls");
}

void check_burning_energy(const CompletedRun& run, Violations& violations) {
  add_drift(run, run.combustion->energy_drift, violations);
}

void check_gas(const CompletedRun& run, Violations& violations) {
  const std::vector<double>& gas = run.combustion->gas_temperature;
  const auto [coldest, hottest] = std::minmax_element(gas.begin(), gas.end());
  if (!(*coldest >= ProductGas::lowest_temperature && *hottest <= ProductGas::highest_temperature))
    violations.push_back(fmt::format("the gas is between {:.4g} and {:.4g} K", *coldest, *hottest));
}

void check_reaction_heat(const CompletedRun& run, Violations& violations) {
  const CombustionHistory& c = *run.combustion;
  if (!(c.energy_residual <= energy_share))
    violations.push_back(fmt::format("burning particles made or lost {:.3g} % of the heat of what burnt",
                                     100.0 * c.energy_residual));
  const double heat = run.scene.charge().kinetics.heat_of_reaction * c.burnt_mass.back();
  if (!(c.released.back() <= (1.0 + sum_share) * heat))
    violations.push_back(fmt::format("{:.4g} J released of {:.4g} J", c.released.back(), heat));
}

/// How an invariant is checked; not at all where there is no function.
struct Check {
  Invariant invariant;
  void (*of_launch)(const CompletedRun&, Violations&);
  void (*of_burn)(const CompletedRun&, Violations&);
};
constexpr Check checks[] = {{Invariant::finite, check_finite, check_finite_burn},
                            {Invariant::mass, check_masses, check_burnt_mass},
                            {Invariant::momentum, check_momentum, nullptr},
                            {Invariant::energy, check_energy, check_burning_energy},
                            {Invariant::dissipation, check_dissipation, nullptr},
                            {Invariant::friction_heat, check_friction, nullptr},
                            {Invariant::temperature, check_skin, check_gas},
                            {Invariant::reaction_heat, nullptr, check_reaction_heat}};

}  // namespace

std::vector<std::string> violations_of(const CompletedRun& run, const StressCase& asked) {
  if (run.combustion && run.combustion->samples() == 0) return {"there is no history of the combustion"};
  Violations violations;
  for (const Check& check : checks) {
    const auto compute = run.combustion ? check.of_burn : check.of_launch;
    if (compute && asked.has(check.invariant)) compute(run, violations);
  }
  return violations;
}

}  // namespace launchsafe::kinds
