// Launches through ignition among the stress cases: what every one that completed must fulfil.
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/materials/product_gas.hpp"
#include "launchsafe/run/validity_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {
namespace {

using run::CombustionHistory;

/// Of the heat of reaction of what burnt, that may be made or lost.
constexpr double energy_share = 0.01;
/// Of masses and heats, which are sums over particles.
constexpr double sum_share = 1e-9;

bool has_numbers(const CombustionHistory& c) {
  const auto all = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  for (const auto* values : {&c.time, &c.burnt_mass, &c.burnt_depth, &c.gas_volume, &c.gas_temperature,
                             &c.pressure, &c.released, &c.kept_back, &c.brought, &c.reaction_degree})
    if (!all(*values)) return false;
  return std::isfinite(c.skin_flame_speed) && std::isfinite(c.bulk_flame_speed);
}

std::vector<std::string> burn_violations(const scene::Scene& scene, const run::CaseResult& result) {
  const CombustionHistory& c = *result.gaps.front().combustion;
  std::vector<std::string> violations;
  if (c.samples() == 0) return {"there is no history of the combustion"};
  if (!has_numbers(c)) return {"the history of the combustion is not finite"};
  if (!(c.energy_residual <= energy_share))
    violations.push_back(fmt::format("burning particles made or lost {:.3g} % of the heat of what burnt",
                                     100.0 * c.energy_residual));
  if (!(c.energy_drift <= scene.numerics.energy_drift_limit))
    violations.push_back(fmt::format("the energy drifts by {:.3g} %, more than {:.3g} %",
                                     100.0 * c.energy_drift, 100.0 * scene.numerics.energy_drift_limit));
  double charge = 0;
  for (const scene::Material& material : scene::used_materials(scene))
    if (std::holds_alternative<materials::Charge>(material.law))
      charge += mass_of(result.mechanics, material.name);
  const double burnt = c.burnt_mass.back();
  if (!(burnt <= (1.0 + sum_share) * charge))
    violations.push_back(fmt::format("{:.6g} kg burnt of a charge of {:.6g} kg", burnt, charge));
  if (!std::is_sorted(c.burnt_mass.begin(), c.burnt_mass.end()))
    violations.emplace_back("the burnt mass falls");
  const double heat = scene.charge().kinetics.heat_of_reaction * burnt;
  if (!(c.released.back() <= (1.0 + sum_share) * heat))
    violations.push_back(fmt::format("{:.4g} J released of {:.4g} J", c.released.back(), heat));
  const auto [coldest, hottest] = std::minmax_element(c.gas_temperature.begin(), c.gas_temperature.end());
  if (!(*coldest >= materials::ProductGas::lowest_temperature &&
        *hottest <= materials::ProductGas::highest_temperature))
    violations.push_back(fmt::format("the gas is between {:.4g} and {:.4g} K", *coldest, *hottest));
  return violations;
}

std::string numbers_of(const CombustionHistory& c) {
  const double pressure = *std::max_element(c.pressure.begin(), c.pressure.end());
  return fmt::format("burnt {:.3g} g to {:.3g} mm, gas at {:.0f} K, up to {:.3g} MPa, energy residual {:.1e}",
                     1e3 * c.burnt_mass.back(), 1e3 * c.burnt_depth.back(), c.gas_temperature.back(),
                     1e-6 * pressure, c.energy_residual);
}

}  // namespace

Finding judge_burn(const scene::Scene& scene, double gap, const run::CaseResult& result) {
  const std::string head = fmt::format("through ignition at {:.6g} cm: ", 100.0 * gap);
  const run::MechanicsResult& mechanics = result.mechanics;
  if (mechanics.status != run::RunStatus::completed) {
    if (mechanics.reason.empty()) return {Outcome::wrong, head + "broke off without a reason"};
    return {Outcome::caught, head + run::to_string(mechanics.status) + ", " + mechanics.reason};
  }
  if (!result.gaps.front().combustion) return {Outcome::degraded, head + "nothing ignited"};
  const std::vector<std::string> violations = burn_violations(scene, result);
  if (!violations.empty()) return {Outcome::wrong, head + fmt::format("{}", fmt::join(violations, "; "))};
  const CombustionHistory& combustion = *result.gaps.front().combustion;
  const std::string numbers = numbers_of(combustion);
  const std::vector<std::string> warnings = run::combustion_validity_warnings(scene, combustion);
  if (warnings.empty()) return {Outcome::held, head + numbers};
  return {Outcome::degraded, head + fmt::format("{}; {}", fmt::join(warnings, "; "), numbers)};
}

Finding joined_finding(Finding launch, const std::vector<Burn>& burns) {
  const auto weight = [](Outcome outcome) {
    switch (outcome) {
      case Outcome::held:
        return 0;
      case Outcome::degraded:
        return 1;
      case Outcome::caught:
        return 2;
      case Outcome::wrong:
        return 3;
    }
    return 3;
  };
  for (const Burn& burn : burns) {
    if (weight(burn.finding.outcome) > weight(launch.outcome)) launch.outcome = burn.finding.outcome;
    launch.text += "; " + burn.finding.text;
  }
  return launch;
}

}  // namespace launchsafe::kinds
