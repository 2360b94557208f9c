// Denormal arguments: no law may answer them with NaN, or slowly. Runs flush denormals; studies, checks and
// tests do not.
#include "launchsafe/run/processor_time.hpp"
#include "law_tests.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::verify::law_tests {

namespace {

constexpr double denormals[] = {4.9e-324, 1e-320, 1e-310, 2e-308};
/// Processor time (s) that one call may take: a denormal operand costs about 150 cycles, and the largest law
/// has a few hundred operations.
constexpr double slow = 1e-4;

LawTest denormal_test(std::string name, std::function<double(double)> call) {
  return {"extreme: denormals", std::move(name), "The result is finite and takes less than 0.1 ms.",
          [call = std::move(call)](Bounds& bounds) { assess_denormals(bounds, call); }};
}

/// Sum of the state and losses of a solid after a step.
double solid_after(double crack_radius, double strain, double element, double step) {
  const Solid solid;
  SolidState state{};
  state.crack_radius = crack_radius;
  for (auto& s : state.elements) s = {element, -element, element};
  const auto loss = advance_solid(solid, step, state, {strain, -strain, strain}, strain);
  return materials::total_deviator(state).rx + state.crack_radius + loss.viscous + loss.crack +
         loss.inelastic_strain;
}

}  // namespace

void assess_denormals(Bounds& bounds, const std::function<double(double)>& law) {
  double broken = 0.0;
  for (const double tiny : denormals) {
    // The fastest of some calls counts, so that other work on the machine does not.
    double best = 1.0;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const double begin = run::thread_processor_time();
      const double sum = law(tiny);
      best = std::min(best, run::thread_processor_time() - begin);
      if (!std::isfinite(sum)) broken += 1.0;
    }
    bounds.never("a call takes longer than 0.1 ms", best > slow);
  }
  bounds.at_most("results that are not finite", broken, 0.0);
}

LawTests denormal_tests() {
  return {
      denormal_test("charge: strain", [](double d) { return solid_after(3e-5, d, 0.0, 1e-7); }),
      denormal_test("charge: stress", [](double d) { return solid_after(3e-5, 0.0, d, 1e-7); }),
      denormal_test("charge: crack radius", [](double d) { return solid_after(d, 1e-4, 1e7, 1e-7); }),
      denormal_test("charge: time step", [](double d) { return solid_after(3e-5, 1e-4, 1e7, d); }),
      denormal_test(
          "steel: trial stress, strain and step",
          [](double d) {
            const materials::JohnsonCookParameters k;
            const auto small = materials::johnson_cook_return<double>(k, {d, d, d}, d, 300.0, 1e-7);
            const auto large = materials::johnson_cook_return<double>(k, {1e9, d, d}, d, 300.0, 1e-7);
            const auto quick = materials::johnson_cook_return<double>(k, {1e9, d, d}, d, d, 1e-300);
            return small.stress.rr + large.stress.rr + quick.stress.rr + large.plastic_work;
          }),
      denormal_test("steel: compression and energy",
                    [](double d) {
                      const materials::MieGruneisenParameters m;
                      const auto state = materials::mie_gruneisen_compress<double>(m, 0.0, d, d, d, d);
                      return state.pressure + state.energy +
                             materials::mie_gruneisen_bulk_modulus<double>(m, d, d);
                    }),
      denormal_test("JWL: pressure and energy",
                    [](double d) {
                      const auto m = materials::unreacted_composition_b();
                      const auto state = materials::jwl_compress<double>(m, 1.0, d, d, 0.99);
                      return state.pressure + state.energy;
                    }),
      denormal_test("air: pressure",
                    [](double d) { return materials::adiabatic_temperature(materials::AirParameters{}, d); }),
      denormal_test("skin: gap, heating and step",
                    [](double d) {
                      surface::SkinModel model;
                      const auto gap = surface::advance_skin(model, d, {300.0}, 1e-6, 300.0, 1500.0, 0.0);
                      const auto heated = surface::advance_skin(model, 3e-4, {300.0}, 1e-6, 300.0, 1500.0, d);
                      const auto brief = surface::advance_skin(model, 3e-4, {300.0}, d, 1500.0, 1500.0, 1e4);
                      return gap.temperature + heated.temperature + brief.temperature;
                    }),
      denormal_test("skin: temperature",
                    [](double d) {
                      return surface::advance_skin(surface::SkinModel{}, 3e-4, {d}, 1e-6, 300.0, 300.0, 0.0)
                          .temperature;
                    }),
  };
}

}  // namespace launchsafe::verify::law_tests
