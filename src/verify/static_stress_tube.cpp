// The thick tube: its hoop stress after Lame, by finite elements, and by particles.
#include "launchsafe/verify/static_stress_comparison.hpp"
#include "mechanics_scenes.hpp"

namespace launchsafe::verify {
namespace {

constexpr double bore = mechanics::tube_bore, outside = mechanics::tube_outside;
constexpr double tube_pressure = 100e6;  // Pa

FiniteElementModel tube_model(const scene::Steel& steel) {
  FiniteElementModel model;
  model.edges_r = graded_edges(bore, outside, 0.625e-3, 0.625e-3);
  model.edges_x = {0.0, 1e-3};
  model.materials = {{steel.eos.density * steel.eos.sound_speed * steel.eos.sound_speed,
                      steel.strength.shear_modulus,
                      steel.eos.density,
                      {}}};
  model.material_of.assign(static_cast<std::size_t>(model.elements()), 0);
  // The laws are linear at a thousandth of the load only.
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
