#include "launchsafe/verify/static_stress_comparison.hpp"

#include "launchsafe/run/run_case.hpp"
#include "mechanics_scenes.hpp"

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

/// The secant bulk modulus from rest to a pressure (Pa) on the equation of state; moduli rise with the
/// pressure, the charge's by 0.8 % under 14 MPa and 8 % under 141 MPa, steel's by 1 % under 500 MPa. With J
/// the relative volume, p = K (1 - J) in CalculiX's neo-Hookean solid, whose tangent shear modulus is G/J,
/// and p = -K ln J in its elastic-plastic one.
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

/// Gives every element the secant moduli at its pressure, rounded to one of 40 classes a material.
FiniteElementModel with_secant_moduli(const FiniteElementModel& at_rest, const FiniteElementResult& result,
                                      const scene::Scene& scene) {
  constexpr int classes = 40;
  std::vector<double> pressure;
  std::vector<std::pair<double, double>> range(at_rest.materials.size(), {0.0, 0.0});
  for (int element = 0; element < at_rest.elements(); ++element) {
    pressure.push_back(mean_pressure(at_rest, result, element));
    auto& [low, high] = range[static_cast<std::size_t>(at_rest.material(element))];
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

/// Means over the box of a station, of the components of stress.
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

/// Runs the particles of a case in cells of `cell_size` (m) and takes the means.
ParticleMeans computed_particle_means(const StaticCase& compared, double cell_size,
                                      const run::RunOptions& options) {
  StaticCase meshed = compared;
  meshed.scene.numerics.cell_size = cell_size;
  const run::MechanicsResult run = run::run_mechanics(meshed.scene, options);
  ParticleMeans result;
  if (run.status == run::RunStatus::completed)
    result = particle_means(meshed, run.snapshots);
  else
    result.failure = run::to_string(run.status) + ": " + run.reason;
  result.cell_size = cell_size;
  result.particles = run.particles;
  result.wall_time = run.wall_time;
  return result;
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

/// Means for rigid contact, by linear extrapolation in the reciprocal of the contact stiffness; `soft` has
/// half the stiffness of `stiff`.
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

/// True for NaN too.
bool exceeds(double value, double limit) { return !(std::abs(value) <= limit); }

void assess_points(const StaticComparison& comparison, const ParticleMeans& mesh, const std::string& where,
                   const StressTargets& targets, std::vector<std::string>& missed) {
  for (std::size_t k = 0; k < comparison.compared.stations.size(); ++k) {
    const StressStation& station = comparison.compared.stations[k];
    const double allowed = station.r <= targets.inner_radius + 1e-9 ? targets.inner : targets.outer;
    const auto compare = [&](const char* what, double found, double expected) {
      const double error = found / expected - 1.0;
      if (!exceeds(error, allowed)) return;
      missed.push_back(fmt::format("{}: {} at {} is {:.5g} MPa, {:+.2f} % from {:.5g} MPa; allowed: {:.3g} %",
                                   where, what, station.name, found / 1e6, 100.0 * error, expected / 1e6,
                                   100.0 * allowed));
    };
    const StressMeasures &mean = mesh.means[k], &reference = comparison.reference()[k];
    compare("pressure", mean.pressure, reference.pressure);
    compare("von Mises stress", mean.von_mises, reference.von_mises);
  }
}

constexpr double tube_pressure = 100e6;                                           // Pa
constexpr double bore = mechanics::tube_bore, outside = mechanics::tube_outside;  // m

FiniteElementModel tube_model(const scene::Steel& steel) {
  FiniteElementModel model;
  model.edges_r = graded_edges(bore, outside, 0.625e-3, 0.625e-3);
  model.edges_x = {0.0, 1e-3};
  model.materials = {{mechanics::bulk_modulus(steel), steel.strength.shear_modulus, steel.eos.density, {}}};
  model.material_of.assign(static_cast<std::size_t>(model.elements()), 0);
  // A thousandth of the load, where the laws are linear; stresses are scaled.
  model.bore_pressure = 1e-3 * tube_pressure;
  model.ends_held = true;
  return model;
}

/// Hoop stress (Pa, at the full load) at a radius, on the line through the two integration points of a row of
/// elements.
double hoop_at(const FiniteElementModel& model, const FiniteElementResult& result, int row, double r) {
  const int element = model.element(0, row);
  const double inner = integration_point(model, element, 0).r, outer = integration_point(model, element, 1).r;
  const double hoop_inner = result.at(element, 0).tt, hoop_outer = result.at(element, 1).tt;
  return 1e3 * (hoop_inner + (hoop_outer - hoop_inner) * (r - inner) / (outer - inner));
}

}  // namespace

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
    model.increment = 0.1;  // the moduli need the pressures to some per cent only
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
    comparison.meshes.push_back(computed_particle_means(compared, cell_size, run_options));
  }
  return comparison;
}

std::vector<std::string> missed_targets(const StaticComparison& comparison) {
  const StressTargets& targets = comparison.compared.targets;
  std::vector<std::string> missed;
  for (const ParticleMeans& mesh : comparison.meshes) {
    const std::string where =
        fmt::format("{}, cells of {:.4g} mm", comparison.compared.name, 1e3 * mesh.cell_size);
    if (!mesh.failure.empty()) {
      missed.push_back(where + ": " + mesh.failure);
      continue;
    }
    assess_points(comparison, mesh, where, targets, missed);
    const bool charge = scene::has_charge(comparison.compared.scene);
    if (charge && exceeds(mesh.alternation, targets.alternation))
      missed.push_back(fmt::format("{}: the pressure alternates by {:.3g} % rms; allowed: {:.3g} %", where,
                                   100.0 * mesh.alternation, 100.0 * targets.alternation));
    const double still = targets.ringing_share * targets.inner;
    for (const double ringing : {mesh.ringing_pressure, mesh.ringing_von_mises})
      if (exceeds(ringing, still))
        missed.push_back(fmt::format("{}: it still moves, by {:.3g} %; allowed: {:.3g} %", where,
                                     100.0 * ringing, 100.0 * still));
  }
  return missed;
}

store::Result<TubeComparison> compare_tube(const ComparisonOptions& options) {
  if (options.progress) options.progress("thick tube");
  const FiniteElementModel model = tube_model({});
  const auto result = run_finite_elements(model, {.time = 60.0, .stop = options.stop});
  if (!result) return result.error();
  TubeComparison tube;
  const double lame = tube_pressure * bore * bore / (outside * outside - bore * bore);
  tube.exact_bore = lame * (1.0 + outside * outside / (bore * bore));
  tube.exact_outside = 2.0 * lame;
  tube.element_bore = hoop_at(model, *result, 0, bore);
  tube.element_outside = hoop_at(model, *result, model.rows() - 1, outside);
  const mechanics::Tube particles = mechanics::relaxed_tube(scene::Formulation::total_lagrangian, 116);
  tube.particle_bore = particles.hoop_bore;
  tube.particle_outside = particles.hoop_outside;
  return tube;
}

}  // namespace launchsafe::verify
