// What every stress case that completed must fulfil.
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/materials/vlw.hpp"

namespace launchsafe::kinds {
namespace {

using materials::ProductGas;
using run::CombustionHistory, run::MonitorSample;

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

/// Says so where something does not hold.
template <class... Args>
void require(bool holds, Sentences& violations, fmt::format_string<Args...> sentence, Args&&... args) {
  if (!holds) violations.push_back(fmt::format(sentence, std::forward<Args>(args)...));
}

bool all_finite(std::initializer_list<const std::vector<double>*> all) {
  return std::ranges::all_of(all, [](const std::vector<double>* values) {
    return std::ranges::all_of(*values, [](double value) { return std::isfinite(value); });
  });
}

// --- of a launch ---

void check_finite(const CompletedRun& run, Sentences& violations) {
  const trace::BottomTrace& trace = run.mechanics.trace;
  bool finite = trace.samples() > 0 && all_finite({&trace.time, &trace.chamber_pressure,
                                                   &trace.bottom_pressure, &trace.mean_bottom_pressure});
  finite = finite && all_finite({&trace.friction});
  require(finite, violations, "the bottom trace is empty or not finite");
  require(std::ranges::all_of(run.mechanics.monitor, run::is_finite), violations,
          "the monitor history is not finite");
}

void check_masses(const CompletedRun& run, Sentences& violations) {
  for (const scene::Material& material : scene::used_materials(run.scene)) {
    const double exact = scene::mass_of(run.scene, material.name);
    const double error = std::abs(mass_of(run.mechanics, material.name) - exact);
    require(error <= mass_share * exact, violations, "the particles' mass of {} is off by {:.2g} of it",
            material.name, error / exact);
  }
}

/// N s, of the load until a time; sums over steps may be off it, as they take the pressure at their begin.
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

void check_momentum(const CompletedRun& run, Sentences& violations) {
  const std::vector<MonitorSample>& monitor = run.mechanics.monitor;
  if (monitor.empty()) return;
  double longest_step = 0;
  for (const MonitorSample& sample : monitor) longest_step = std::max(longest_step, sample.time_step);
  const Impulse impulse = impulse_until(run.scene, run.mechanics.end_time, longest_step);
  double largest = 0;
  for (const MonitorSample& sample : monitor)
    if (!(std::abs(sample.momentum) <= largest)) largest = std::abs(sample.momentum);
  // That of a hundredth of an atmosphere over the launch: without a load there is nothing but round-off.
  const double least = 1e3 * scene::base_area(run.scene) * scene::end_time(run.scene.load);
  const double scale = std::max(impulse.value + impulse.error, least);
  require(
      largest <= momentum_share * scale, violations,
      "the momentum relative to the co-moving frame reaches {:.3g} kg m/s; the load's impulse is {:.4g} N s",
      largest, impulse.value);
}

double largest_energy(const std::vector<MonitorSample>& monitor) {
  double largest = 0;
  for (const MonitorSample& sample : monitor) largest = std::max(largest, sample.energy.scale());
  return largest;
}

/// Against the largest energy, or the least that balances are judged on. With what burnt the run has it.
void check_energy(const CompletedRun& run, Sentences& violations) {
  const std::vector<MonitorSample>& monitor = run.mechanics.monitor;
  double drift = 0;
  for (const MonitorSample& sample : monitor)
    drift = std::max(drift, std::abs(sample.energy.drift()) * sample.energy.scale());
  drift /= std::max(run::least_judged_energy(run.scene), largest_energy(monitor));
  if (run.combustion) drift = run.combustion->energy_drift;
  const double limit = run.scene.numerics.energy_drift_limit;
  require(drift <= limit, violations, "the energy drifts by {:.3g} %, more than {:.3g} %", 100.0 * drift,
          100.0 * limit);
}

void check_dissipation(const CompletedRun& run, Sentences& violations) {
  using run::EnergyBalance;
  const std::vector<MonitorSample>& monitor = run.mechanics.monitor;
  const double scale = largest_energy(monitor);
  for (const auto& [name, part] : {std::pair{"plastic", &EnergyBalance::plastic},
                                   {"viscous", &EnergyBalance::viscous},
                                   {"crack", &EnergyBalance::crack}}) {
    for (std::size_t i = 1; i < monitor.size(); ++i) {
      const double change = monitor[i].energy.*part - monitor[i - 1].energy.*part;
      if (change >= -dissipation_share * scale) continue;
      violations.push_back(
          fmt::format("{} dissipation falls by {:.3g} J at {:.4g} ms", name, -change, 1e3 * monitor[i].time));
      break;
    }
  }
}

void check_friction(const CompletedRun& run, Sentences& violations) {
  const trace::BottomTrace& trace = run.mechanics.trace;
  const std::size_t stations = trace.stations.size();
  for (std::size_t i = stations; stations > 0 && i < trace.friction.size(); ++i) {
    if (trace.friction[i] >= trace.friction[i - stations]) continue;
    violations.push_back(fmt::format("friction heat falls at station {}", trace.stations[i % stations].name));
    return;
  }
}

void check_skin(const CompletedRun& run, Sentences& violations) {
  const trace::BottomTrace& trace = run.mechanics.trace;
  if (trace.samples() == 0) return;
  const surface::SkinModel model = surface::skin_model(run.scene);
  const double coldest = std::min(run.scene.initial_temperature, run.scene.surface.air.initial_temperature);
  for (const double gap : run.gaps) {
    const surface::SkinHistory skin = surface::integrate_skin(model, trace, gap);
    if (skin.temperature.empty()) continue;
    const double lowest = std::ranges::min(skin.temperature);
    require(!(lowest < coldest - temperature_slack), violations,
            "the skin falls to {:.5g} K, below {:.5g} K at first, at {:.6g} cm", lowest, coldest,
            100.0 * gap);
  }
}

// --- of what burnt ---

void check_finite_burn(const CompletedRun& run, Sentences& violations) {
  const CombustionHistory& c = *run.combustion;
  require(all_finite({&c.time, &c.burnt_mass, &c.gas_volume, &c.gas_temperature, &c.pressure, &c.released,
                      &c.brought, &c.reaction_degree}),
          violations, "the history of the combustion is not finite");
}

void check_burnt_mass(const CompletedRun& run, Sentences& violations) {
  const std::vector<double>& burnt = run.combustion->burnt_mass;
  double charge = 0;
  for (const scene::Material& material : scene::used_materials(run.scene))
    if (std::holds_alternative<materials::Charge>(material.law))
      charge += mass_of(run.mechanics, material.name);
  require(burnt.back() <= (1.0 + sum_share) * charge, violations, "{:.6g} kg burnt of a charge of {:.6g} kg",
          burnt.back(), charge);
  require(std::ranges::is_sorted(burnt), violations, "the burnt mass falls");
}

void check_gas(const CompletedRun& run, Sentences& violations) {
  const auto [coldest, hottest] = std::ranges::minmax_element(run.combustion->gas_temperature);
  require(*coldest >= ProductGas::lowest_temperature && *hottest <= ProductGas::highest_temperature,
          violations, "the gas is between {:.4g} and {:.4g} K", *coldest, *hottest);
}

void check_reaction_heat(const CompletedRun& run, Sentences& violations) {
  const CombustionHistory& c = *run.combustion;
  require(c.energy_residual <= energy_share, violations,
          "burning particles made or lost {:.3g} % of the heat of what burnt", 100.0 * c.energy_residual);
  const double heat = run.scene.charge().kinetics.heat_of_reaction * c.burnt_mass.back();
  require(c.released.back() <= (1.0 + sum_share) * heat, violations, "{:.4g} J released of {:.4g} J",
          c.released.back(), heat);
}

}  // namespace

const std::vector<Invariant>& all_invariants() {
  static const std::vector<Invariant> all{
      {"finite", "all numbers are finite", check_finite, check_finite_burn},
      {"mass", "bodies keep theirs; no more burns than the charge has", check_masses, check_burnt_mass},
      {"momentum", "none relative to the co-moving frame", check_momentum},
      {"energy", "drifts within the scene's limit", check_energy, check_energy},
      {"dissipation", "never falls", check_dissipation},
      {"friction-heat", "never falls", check_friction},
      {"temperature", "no skin is colder than at first, no gas beyond its law", check_skin, check_gas},
      {"reaction-heat", "no more is released than what burnt has, and less than 1 % of it made or lost",
       nullptr, check_reaction_heat},
      {"same-temperature", "T max is that of the safe computation `against`"}};
  return all;
}

Sentences violations_of(const CompletedRun& run) {
  if (run.combustion && run.combustion->samples() == 0) return {"there is no history of the combustion"};
  Sentences violations;
  for (const Invariant& invariant : all_invariants())
    if (const auto check = run.combustion ? invariant.of_burn : invariant.of_launch) check(run, violations);
  return violations;
}

}  // namespace launchsafe::kinds
