#include "launchsafe/verify/static_stress_comparison.hpp"

#include "mechanics_scenes.hpp"
#include "static_stress_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace launchsafe::verify {
namespace {

/// Pressure (Pa) on the isentrope through rest at a relative volume, by the equation of state.
double isentrope(const scene::Scene& scene, bool of_charge, double volume) {
  if (of_charge) {
    const materials::JwlParameters& law = scene.charge().eos;
    return materials::jwl_isentrope(law, 1.0, law.initial_energy, volume).pressure;
  }
  return materials::mie_gruneisen_compress(scene.steel().eos, 0.0, 0.0, 0.0, 1.0 / volume - 1.0, 0.0)
      .pressure;
}

/// Relative volume at a pressure (Pa), by bisection.
double volume_at(const scene::Scene& scene, bool of_charge, double pressure) {
  double low = 0.8, high = 1.2;
  for (int k = 0; k < 60; ++k) {
    const double volume = 0.5 * (low + high);
    (isentrope(scene, of_charge, volume) > pressure ? low : high) = volume;
  }
  return 0.5 * (low + high);
}

/// Bodies stiffen as they are compressed, the charge by 0.8 % under 14 MPa and 8 % under 141, steel by 1 %
/// under 500: each element gets the secant modulus that leads from rest to its own pressure. With J the
/// relative volume, p = K (1 - J) in a neo-Hookean solid, where a small shear meets the modulus G/J, and p =
/// -K ln J in one that yields.
FiniteElementMaterial secant_material(const FiniteElementMaterial& at_rest, const scene::Scene& scene,
                                      bool of_charge, double pressure) {
  if (!(std::abs(pressure) > 1e3)) return at_rest;
  const double volume = volume_at(scene, of_charge, pressure);
  FiniteElementMaterial secant = at_rest;
  secant.bulk_modulus = at_rest.hardening.empty() ? pressure / (1.0 - volume) : -pressure / std::log(volume);
  secant.shear_modulus = at_rest.shear_modulus * volume;
  return secant;
}

double mean_pressure(const FiniteElementModel& model, const FiniteElementResult& result, int element) {
  double pressure = 0.0, weight = 0.0;
  for (int point = 0; point < integration_points; ++point) {
    const double share = integration_point(model, element, point).weight;
    pressure += share * result.at(element, point).measures().pressure;
    weight += share;
  }
  return pressure / weight;
}

/// Gives every element the secant moduli of the class into which its pressure falls.
FiniteElementModel with_secant_moduli(const FiniteElementModel& at_rest, const FiniteElementResult& result,
                                      const scene::Scene& scene) {
  constexpr int classes = 40;
  std::vector<double> pressure;
  std::vector<std::pair<double, double>> range(at_rest.materials.size(), {0.0, 0.0});
  for (int element = 0; element < at_rest.elements(); ++element) {
    pressure.push_back(mean_pressure(at_rest, result, element));
    auto& [low, high] =
        range[static_cast<std::size_t>(at_rest.material_of[static_cast<std::size_t>(element)])];
    low = std::min(low, pressure.back());
    high = std::max(high, pressure.back());
  }
  FiniteElementModel model = at_rest;
  model.materials.clear();
  for (std::size_t m = 0; m < at_rest.materials.size(); ++m)
    for (int k = 0; k < classes; ++k)
      model.materials.push_back(
          secant_material(at_rest.materials[m], scene, m == 1,
                          range[m].first + (k + 0.5) / classes * (range[m].second - range[m].first)));
  for (std::size_t element = 0; element < pressure.size(); ++element) {
    const int material = at_rest.material_of[element];
    const auto [low, high] = range[static_cast<std::size_t>(material)];
    const double share = high > low ? (pressure[element] - low) / (high - low) : 0.0;
    model.material_of[element] =
        material * classes + std::min(static_cast<int>(share * classes), classes - 1);
  }
  return model;
}

constexpr int secant_passes = 2;

using Clock = std::chrono::steady_clock;

store::Result<FiniteElementMeans> means_of(const StaticCase& compared, const FiniteElementModel& model,
                                           const store::ProgramLimits& limits) {
  const auto start = Clock::now();
  const auto result = run_finite_elements(model, limits);
  if (!result) return result.error();
  FiniteElementMeans means;
  means.elements = model.elements();
  means.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
  for (const StressStation& station : compared.stations)
    means.means.push_back(box_mean(model, *result, compared.scene, station));
  return means;
}

/// From two stiffnesses of contact, the second half the first, to faces that do not give at all: what they
/// give goes with the reciprocal of the stiffness, and so do stresses.
FiniteElementMeans rigid_contact(const FiniteElementMeans& stiff, const FiniteElementMeans& soft) {
  FiniteElementMeans means = stiff;
  means.wall_time += soft.wall_time;
  const auto extrapolate = [&](double& value, double softer) {
    const double change = value - softer;
    means.contact_correction = std::max(means.contact_correction, std::abs(change / value));
    value += change;
  };
  for (std::size_t k = 0; k < means.means.size(); ++k) {
    extrapolate(means.means[k].pressure, soft.means[k].pressure);
    extrapolate(means.means[k].von_mises, soft.means[k].von_mises);
  }
  return means;
}

store::Result<FiniteElementMeans> converged_means_of(const StaticCase& compared,
                                                     const FiniteElementModel& model,
                                                     const store::ProgramLimits& limits) {
  auto stiff = means_of(compared, model, limits);
  if (!stiff || model.contacts.empty()) return stiff;
  FiniteElementModel softer = model;
  softer.contact_stiffness *= 0.5;
  softer.stick_stiffness *= 0.5;
  auto soft = means_of(compared, softer, limits);
  if (!soft) return soft;
  return rigid_contact(*stiff, *soft);
}

}  // namespace

StressMeasures box_mean(const FiniteElementModel& model, const FiniteElementResult& result,
                        const scene::Scene& scene, const StressStation& station) {
  const double bottom = bottom_of(scene);
  CauchyStress mean;
  double total = 0.0;
  for (int element = 0; element < model.elements(); ++element)
    for (int point = 0; point < integration_points; ++point) {
      const IntegrationPoint at = integration_point(model, element, point);
      if (at.x > bottom || at.x < bottom - stress_box || std::abs(at.r - station.r) > 0.5 * stress_box)
        continue;
      const CauchyStress& stress = result.at(element, point);
      mean.rr += at.weight * stress.rr;
      mean.xx += at.weight * stress.xx;
      mean.tt += at.weight * stress.tt;
      mean.rx += at.weight * stress.rx;
      total += at.weight;
    }
  return CauchyStress{mean.rr / total, mean.xx / total, mean.tt / total, mean.rx / total}.measures();
}

store::Result<StaticComparison> compare_static_stresses(const StaticCase& compared,
                                                        const ComparisonOptions& options) {
  const store::ProgramLimits limits{.time = 900.0, .stop = options.stop};
  const auto tell = [&](const std::string& what) {
    if (options.progress) options.progress(compared.name + ": " + what);
  };
  StaticComparison comparison;
  comparison.compared = compared;
  tell("finite elements");
  const FiniteElementModel at_rest = finite_element_model(compared);
  FiniteElementModel model = at_rest;
  for (int pass = 0; pass < secant_passes; ++pass) {
    model.increment = 0.1;  // near enough to know the moduli
    const auto result = run_finite_elements(model, limits);
    if (!result) return result.error();
    model = with_secant_moduli(at_rest, *result, compared.scene);
  }
  auto coarse = converged_means_of(compared, model, limits);
  if (!coarse) return coarse.error();
  comparison.coarse = std::move(*coarse);
  tell("finer finite elements");
  auto fine = converged_means_of(compared, refined(model), limits);
  if (!fine) return fine.error();
  comparison.fine = std::move(*fine);
  for (const double cell_size : options.cell_sizes) {
    tell(fmt::format("particles in cells of {:.3g} mm", 1e3 * cell_size));
    run::RunOptions run_options;
    run_options.stop = options.stop;
    comparison.meshes.push_back(particle_means(compared, cell_size, run_options));
  }
  return comparison;
}

}  // namespace launchsafe::verify
