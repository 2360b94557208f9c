// Crack growth far beyond its runaway.
#include "launchsafe/run/processor_time.hpp"
#include "law_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::verify::law_tests {

namespace {

constexpr double runaway = 24e6;  // Pa, model section 4

/// Elements that a sudden strain has just brought to a von Mises stress (Pa) together.
SolidState strained(const Solid& solid, double stress) {
  SolidState state{};
  state.crack_radius = solid.initial_crack_radius;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n)
    state.elements[n].rx = stress / std::sqrt(3.0) * solid.shear_moduli[n] / solid.shear_modulus();
  return state;
}

/// Elastic energy (J/m3) of the elements and of the open cracks: sum S_n:S_n/(4 G_n) + q S:S/(4 G).
double energy_of(const Solid& solid, const SolidState& state) {
  const auto total = materials::total_deviator(state);
  double energy = materials::crack_strain_ratio(solid, state.crack_radius) * math::contract(total, total) /
                  (4.0 * solid.shear_modulus());
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n)
    energy += math::contract(state.elements[n], state.elements[n]) / (4.0 * solid.shear_moduli[n]);
  return energy;
}

/// State and dissipation (J/m3) after a held strain.
struct HeldStrain {
  SolidState state{};
  double viscous = 0.0, crack = 0.0;
};

HeldStrain hold_strain(Bounds& bounds, const SolidLaw& law, const Solid& solid, double stress,
                       double pressure, double dt, int steps) {
  HeldStrain held{strained(solid, stress)};
  for (int k = 0; k < steps; ++k) {
    const double before = held.state.crack_radius;
    const auto loss = law(solid, dt / steps, held.state, {}, pressure);
    held.viscous += loss.viscous;
    held.crack += loss.crack;
    bounds.never("a crack heals", held.state.crack_radius < before);
    bounds.never("a number is not finite",
                 !std::isfinite(held.state.crack_radius + loss.viscous + loss.crack));
    bounds.never("a crack passes its bound", held.state.crack_radius > solid.largest_crack_radius);
    bounds.at_most("growth, share of what the largest speed allows",
                   (held.state.crack_radius - before) / (solid.largest_growth_speed * dt / steps),
                   1.0 + 1e-9);
    bounds.never("cracks give energy back", loss.crack < 0.0);
    bounds.at_most("negative viscous dissipation, share of the energy",
                   std::max(0.0, -loss.viscous) / energy_of(solid, strained(solid, stress)), 1e-12);
  }
  return held;
}

}  // namespace

void assess_growth(Bounds& bounds, const SolidLaw& law, double stress, double pressure, double step) {
  Solid solid;
  if (!(pressure > 0.0)) solid.face_friction = 0.0;
  const double begin = run::thread_processor_time();
  const HeldStrain coarse = hold_strain(bounds, law, solid, stress, pressure, step, 1);
  bounds.never("a step takes longer than 50 ms", run::thread_processor_time() - begin > longest_step);
  const HeldStrain fine = hold_strain(bounds, law, solid, stress, pressure, step, 1000);
  bounds.at_most("crack radius of one step against a thousand, share",
                 std::abs(coarse.state.crack_radius / fine.state.crack_radius - 1.0), 0.01);
  const double energy = energy_of(solid, strained(solid, stress));
  const auto stress_of = [](const HeldStrain& held) {
    return math::von_mises(materials::total_deviator(held.state));
  };
  bounds.at_most("stress of one step against a thousand, share of the first",
                 std::abs(stress_of(coarse) - stress_of(fine)) / stress, 1e-3);
  for (const HeldStrain* held : {&coarse, &fine}) {
    // Strain is held, so nothing is put in.
    const double left = energy - energy_of(solid, held->state) - held->viscous - held->crack;
    bounds.at_most("energy that is neither stored nor lost, share", std::abs(left) / energy, 1e-2);
  }
}

StressTests growth_tests() {
  StressTests tests;
  for (const double factor : {1.0, 10.0, 1000.0}) {
    for (const double pressure : {0.0, 141e6, 5e9}) {
      const std::string under =
          pressure > 0.0 ? fmt::format("under {:g} MPa with friction", 1e-6 * pressure) : "without friction";
      tests.push_back(stress_test(
          "stiff: crack growth",
          fmt::format("{:g} times the stress of runaway, {}, steps 1 ns to 0.1 ms", factor, under),
          "Cracks grow, stay finite and bounded, never faster than v_max; one step agrees with a thousand "
          "to "
          "the 1 % of its radius that a sub-step may grow; energy is stored or lost to 1 %; no step takes "
          "longer than "
          "50 ms.",
          [factor, pressure](Bounds& bounds) {
            for (const double step : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4})
              assess_growth(bounds, advance_solid, factor * runaway, pressure, step);
          }));
    }
  }
  return tests;
}

}  // namespace launchsafe::verify::law_tests
