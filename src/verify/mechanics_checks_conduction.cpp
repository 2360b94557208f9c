// Heat conduction in the charge against the half space of Carslaw & Jaeger, and its conservation and bounds.
#include "checks.hpp"
#include "error_settings.hpp"
#include "launchsafe/mpm/conduction.hpp"
#include "mechanics_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::verify {
namespace mechanics {
namespace {

constexpr double micrometre = 1e-6, duration = 1e-3;

/// A strip of charge 0.1 mm long, eleven diffusion lengths of 1 ms; its base is the half space's face.
scene::Scene strip(double cell) {
  scene::Scene scene = block("charge", 100.0 * micrometre, cell, cell);
  scene.symmetry = scene::Symmetry::plane_strain;
  return scene;
}

void conduct(mpm::Conduction& conduction, mpm::Simulation& simulation, double time, int steps) {
  for (int step = 0; step < steps; ++step) conduction.advance(simulation, time / steps);
}

/// Random temperatures from 300 to 1300 K, the same in every run.
void set_random_temperatures(mpm::Simulation& simulation) {
  std::uint32_t random = 1;
  const auto set = [&](mpm::ParticleFields& p) {
    for (double& temperature : p.temperature) {
      random = random * 1664525U + 1013904223U;
      temperature = 300.0 + 1000.0 * static_cast<double>(random >> 8) / 16777215.0;
    }
  };
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>()) set(body.particles);
  for (mpm::Body<materials::Charge>& body : simulation.bodies_of<materials::Charge>()) set(body.particles);
}

/// Relative L2 error of the temperature rise in a half space whose face is held 1 K hotter, after 1 ms, in
/// cells of `cell` (m) and `steps` equal steps.
double half_space_error(double cell, int steps) {
  mpm::Simulation simulation(strip(cell));
  mpm::Conduction conduction(simulation);
  const double initial = simulation.scene().initial_temperature;
  conduction.hold_base(initial + 1.0);
  conduct(conduction, simulation, duration, steps);
  const scene::Charge& charge = simulation.scene().charge();
  const double diffusivity = charge.conductivity / (charge.eos.initial_density * charge.specific_heat);
  const mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  const double face = p.lattice.x_begin() + p.lattice.columns() * p.lattice.length_x(0);
  RelativeError error;
  for (int i = 0; i < p.lattice.columns(); ++i) {
    const double exact = std::erfc((face - p.lattice.x_of(i)) / (2.0 * std::sqrt(diffusivity * duration)));
    error.add(p.temperature[p.lattice.slot(i, 0)] - initial, exact);
  }
  return error.value();
}

Checks conduction_from_a_hot_face() {
  mpm::Simulation simulation(strip(0.5 * micrometre));
  mpm::Conduction conduction(simulation);
  conduction.hold_base(simulation.scene().initial_temperature + 1.0);
  conduct(conduction, simulation, duration, 1000);
  const mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  const int face = 180;  // 10 um from the base, between two particles
  const double rise =
      0.5 * (p.temperature[p.lattice.slot(face - 1, 0)] + p.temperature[p.lattice.slot(face, 0)]) - 300.0;
  const scene::Charge& charge = simulation.scene().charge();
  return {
      {"diffusivity of the charge", charge.conductivity / (charge.eos.initial_density * charge.specific_heat),
       8.049053e-8, 1e-7, "m2/s", "k/(rho c)", Tolerance::relative},
      {"share of the face's rise 10 um deep after 1 ms", rise, 0.430605, 5e-4, "",
       "Carslaw & Jaeger, half space: erfc"}};
}

Check conduction_under_flux() {
  mpm::Simulation simulation(strip(0.5 * micrometre));
  mpm::Conduction conduction(simulation);
  conduction.heat_base(1e6);
  conduct(conduction, simulation, duration, 1000);
  const mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  const int last = p.lattice.columns() - 1;
  // The face lies half a spacing beyond the last particle; the slope there is q/k.
  const double half_spacing = 0.5 * p.lattice.length_x(0);
  const double surface = p.temperature[p.lattice.slot(last, 0)] +
                         half_spacing * 1e6 / simulation.scene().charge().conductivity - 300.0;
  return {"surface rise under 1 MW/m2 after 1 ms",
          surface,
          41.15213,
          1e-3,
          "K",
          "Carslaw & Jaeger, half space: 2 q sqrt(t/(pi k rho c))",
          Tolerance::relative};
}

Check conserved_heat() {
  mpm::Simulation simulation(shell_155(10e-3));
  set_random_temperatures(simulation);
  mpm::Conduction conduction(simulation);
  const double before = conduction.heat(simulation);
  conduct(conduction, simulation, 20.0, 100);
  return {"change of the heat of the shell over 100 steps of 0.2 s",
          conduction.heat(simulation) / before - 1.0,
          0.0,
          1e-12,
          "",
          "adiabatic faces"};
}

Checks conduction_in_long_steps() {
  // Of the charge, alpha dt/h^2; of the steel a hundred times more.
  constexpr double fourier_number = 1e4, cell = 10e-3;
  mpm::Simulation simulation(shell_155(cell));
  const double dt = step_of_fourier_number(simulation.scene().charge(), cell, fourier_number);
  set_random_temperatures(simulation);
  mpm::Conduction conduction(simulation);
  const TemperatureRange before = range_of(simulation);
  double outside = 0.0;
  for (int step = 0; step < 3; ++step) {
    conduction.advance(simulation, dt);
    const TemperatureRange now = range_of(simulation);
    outside = std::max({outside, before.low - now.low, now.high - before.high});
  }
  const TemperatureRange after = range_of(simulation);
  return {{"temperature beyond the initial extremes, Fourier number 1e4", outside, 0.0, 1e-9, "K",
           "maximum principle"},
          {"spread left after three steps at Fourier number 1e4", after.high - after.low, 0.0, 1e-3, "K",
           "heat spreads evenly in the end"}};
}

}  // namespace
}  // namespace mechanics

std::vector<Computation> conduction_computations() {
  return {{"conduction", [] {
             Checks checks = mechanics::conduction_from_a_hot_face();
             checks.push_back(mechanics::conduction_under_flux());
             checks.push_back(mechanics::conserved_heat());
             for (Check& check : mechanics::conduction_in_long_steps()) checks.push_back(std::move(check));
             return checks;
           }}};
}

std::vector<ErrorSeries> conduction_series() {
  const std::string part = "conduction", strip = "1 ms of a strip of 0.1 mm";
  const std::string half_space = "erfc of the half space, relative L2";
  return {{part, "temperature, by step", strip + " in cells of 0.25 um", half_space, "",
           "backward Euler is of first order", 1.0, 1e-12,
           [] {
             constexpr double cell = 0.25e-6;  // m: leaves an error of 3e-5
             return settings_for({5, 10, 20, 40, 80}, [](int steps) {
               return with_steps(mechanics::duration, steps,
                                 [=] { return mechanics::half_space_error(cell, steps); });
             });
           }},
          {part, "temperature, by cell", strip + ", the step going with the square of the cell", half_space,
           "", "finite volumes are of second order", 2.0, 1e-12, [] {
             // With the square of the spacing the first-order error of the step falls as that of the spacing.
             return settings_for({1, 2, 4, 8}, [](int division) {
               const double cell = 8e-6 / division;
               return with_cell(cell,
                                [=] { return mechanics::half_space_error(cell, 20 * division * division); });
             });
           }}};
}

}  // namespace launchsafe::verify
