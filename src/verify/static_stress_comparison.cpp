#include "launchsafe/verify/static_stress_comparison.hpp"

#include "mechanics_scenes.hpp"
#include "static_stress_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace launchsafe::verify {
namespace {

/// Relative volume at a pressure (Pa) on the isentrope through the charge at rest, by bisection.
double volume_at(const materials::JwlParameters& law, double pressure) {
  double low = 0.8, high = 1.2;
  for (int k = 0; k < 60; ++k) {
    const double v = 0.5 * (low + high);
    (materials::jwl_isentrope(law, 1.0, law.initial_energy, v).pressure > pressure ? low : high) = v;
  }
  return 0.5 * (low + high);
}

/// The charge stiffens as it is compressed, by 0.8 % under 14 MPa and 8 % under 141: each element gets the
/// secant modulus that leads from rest to its own pressure. In a neo-Hookean solid of volume ratio J,
/// p = K (1 - J), and a small shear meets the modulus G/J.
FiniteElementMaterial secant_material(const FiniteElementMaterial& at_rest,
                                      const materials::JwlParameters& law, double pressure) {
  if (!(std::abs(pressure) > 1e3)) return at_rest;
  const double volume = volume_at(law, pressure);
  FiniteElementMaterial secant = at_rest;
  secant.bulk_modulus = pressure / (1.0 - volume);
  secant.shear_modulus = at_rest.shear_modulus * volume;
  return secant;
}

constexpr int charge_material = 1;
constexpr int pressure_classes = 40;

double mean_pressure(const FiniteElementModel& model, const FiniteElementResult& result, int element) {
  double pressure = 0.0, weight = 0.0;
  for (int point = 0; point < integration_points; ++point) {
    const double share = integration_point(model, element, point).weight;
    pressure += share * result.at(element, point).measures().pressure;
    weight += share;
  }
  return pressure / weight;
}

/// Gives every element of the charge the secant modulus of the class into which its pressure falls.
FiniteElementModel with_secant_moduli(const FiniteElementModel& linear, const FiniteElementModel& last,
                                      const FiniteElementResult& result,
                                      const materials::JwlParameters& law) {
  FiniteElementModel model = linear;
  std::vector<double> pressure(static_cast<std::size_t>(model.elements()), 0.0);
  double low = 0.0, high = 0.0;
  for (int element = 0; element < model.elements(); ++element) {
    if (linear.material_of[static_cast<std::size_t>(element)] != charge_material) continue;
    const double p = pressure[static_cast<std::size_t>(element)] = mean_pressure(last, result, element);
    low = std::min(low, p);
    high = std::max(high, p);
  }
  const double width = (high - low) / pressure_classes;
  if (!(width > 0.0)) return model;
  const FiniteElementMaterial at_rest = linear.materials[charge_material];
  model.materials.resize(charge_material);
  for (int k = 0; k < pressure_classes; ++k)
    model.materials.push_back(secant_material(at_rest, law, low + (k + 0.5) * width));
  for (std::size_t element = 0; element < pressure.size(); ++element) {
    if (linear.material_of[element] != charge_material) continue;
    const int k = static_cast<int>((pressure[element] - low) / width);
    model.material_of[element] = charge_material + std::min(k, pressure_classes - 1);
  }
  return model;
}

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

}  // namespace

StressMeasures box_mean(const FiniteElementModel& model, const FiniteElementResult& result,
                        const scene::Scene& scene, const StressStation& station) {
  const double bottom = bottom_of(scene);
  StressMeasures mean;
  double total = 0.0;
  for (int element = 0; element < model.elements(); ++element)
    for (int point = 0; point < integration_points; ++point) {
      const IntegrationPoint at = integration_point(model, element, point);
      if (at.x > bottom || at.x < bottom - stress_box || std::abs(at.r - station.r) > 0.5 * stress_box)
        continue;
      const StressMeasures stress = result.at(element, point).measures();
      mean.pressure += at.weight * stress.pressure;
      mean.von_mises += at.weight * stress.von_mises;
      total += at.weight;
    }
  return {mean.pressure / total, mean.von_mises / total};
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
  const FiniteElementModel linear = finite_element_model(compared);
  FiniteElementModel model = linear;
  if (scene::has_material(compared.scene, scene::BodyMaterial::charge)) {
    constexpr int passes = 2;  // the second changes the box means by less than 1e-4
    for (int pass = 0; pass < passes; ++pass) {
      const auto result = run_finite_elements(model, limits);
      if (!result) return result.error();
      model = with_secant_moduli(linear, model, *result, compared.scene.charge.eos);
    }
  }
  auto coarse = means_of(compared, model, limits);
  if (!coarse) return coarse.error();
  comparison.coarse = std::move(*coarse);
  tell("finer finite elements");
  auto fine = means_of(compared, refined(model), limits);
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
