// Elastic waves in steel against d'Alembert. Loads are small (strains of 1e-7), so that the laws are linear,
// and the numbers are scaled to 100 MPa where model section 10 gives them so.
#include "checks.hpp"
#include "error_settings.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::verify {
namespace mechanics {
namespace {

constexpr double peak = 1e5;  // Pa

/// Relative L2 errors of a travelling pulse.
struct WaveError {
  double velocity = 0, stress = 0;
};

/// A pulse enters a strip of 1 m, divided into `cells`, in a rigid barrel, where only the longitudinal wave
/// can run: v = -p(t - (L - X)/c)/(rho c), sigma = -p(t - (L - X)/c). After a step the velocity is that of
/// its middle. It is compared as the mean of two neighbours, which is what their node sees: the alternating
/// part of the particles' velocities (1e-3 of the peak here) is invisible to the grid and acts on nothing.
WaveError longitudinal_error(scene::Formulation formulation, int cells) {
  const double length = 1.0;
  scene::Scene strip = block("steel", length, 2.0 / cells, length / cells, formulation);
  strip.symmetry = scene::Symmetry::plane_strain;
  strip.frame = scene::Frame::lab;
  const scene::Steel& steel = strip.steel();
  const double density = steel.eos.density;
  const double wave_speed =
      std::sqrt((bulk_modulus(steel) + 4.0 / 3.0 * steel.strength.shear_modulus) / density);
  const double peak_time = 0.5 * length / wave_speed;
  strip.load = pulse(peak, peak_time);
  mpm::Simulation simulation(strip);
  const double dt = run_to(simulation, 1.8 * peak_time);
  const scene::PressureHistory pressure(strip.load);
  const mpm::Body<materials::Steel>& body = simulation.bodies_of<materials::Steel>()[0];
  const mpm::Lattice& lattice = body.particles.lattice;
  RelativeError velocity, stress;
  for (int i = 0; i + 1 < lattice.columns(); ++i) {
    const std::size_t slot = lattice.slot(i, 0), next = lattice.slot(i + 1, 0);
    const double node = 0.5 * (lattice.x_of(i) + lattice.x_of(i + 1));
    const double at_node = simulation.time() - 0.5 * dt - (length - node) / wave_speed;
    velocity.add(0.5 * (body.particles.velocity_x[slot] + body.particles.velocity_x[next]),
                 -pressure.at(at_node) / (density * wave_speed));
    const double at_particle = simulation.time() - (length - lattice.x_of(i)) / wave_speed;
    stress.add(axial_stress(body, slot), -pressure.at(at_particle));
  }
  return {velocity.value(), stress.value()};
}

Checks longitudinal_pulse(scene::Formulation formulation) {
  Checks checks;
  const std::string second_order = "d'Alembert; uGIMP on smooth fields and the leapfrog are of second order";
  const std::vector<int> cells{50, 100, 200, 400};
  std::vector<WaveError> errors;
  for (const int count : cells) errors.push_back(longitudinal_error(formulation, count));
  for (std::size_t k = 1; k < cells.size(); ++k) {
    const std::string meshes = fmt::format("{} to {} cells", cells[k - 1], cells[k]);
    checks.push_back({"order of convergence of the velocity, " + meshes,
                      observed_order(errors[k - 1].velocity, errors[k].velocity, 2.0), 2.0, 0.1, "",
                      second_order});
    checks.push_back({"order of convergence of the stress, " + meshes,
                      observed_order(errors[k - 1].stress, errors[k].stress, 2.0), 2.0, 0.1, "",
                      second_order});
  }
  checks.push_back(
      {"relative error of the stress, 400 cells", errors.back().stress, 0.0, 5e-4, "", "d'Alembert"});
  scene::Scene strip = block("steel", 1.0, 0.01, 0.005, formulation);
  strip.symmetry = scene::Symmetry::plane_strain;
  strip.frame = scene::Frame::lab;
  strip.load = pulse(peak, 4e-5);
  mpm::Simulation simulation(strip);
  checks.push_back({"longitudinal speed", speed_of_pulse(simulation, 1.1e-4, 1.6e-4), 5905.50, 1e-4, "m/s",
                    "sqrt((K + 4/3 G)/rho); centre of a pulse's momentum", Tolerance::relative});
  return checks;
}

scene::Scene free_bar(double length, const scene::Load& load, scene::Formulation formulation) {
  scene::Scene bar = block("steel", length, 0.005, 0.0025, formulation);
  bar.frame = scene::Frame::lab;
  bar.barrel = scene::Barrel::none;
  bar.load = load;
  return bar;
}

Check pulse_in_a_free_bar(scene::Formulation formulation) {
  mpm::Simulation simulation(free_bar(2.0, pulse(peak, 1e-4), formulation));
  return {"bar speed",
          speed_of_pulse(simulation, 2.5e-4, 3.5e-4),
          5139.83,
          1e-3,
          "m/s",
          "sqrt(E/rho); a pulse much longer than the bar is thick",
          Tolerance::relative};
}

Check plateau_in_a_free_bar(scene::Formulation formulation) {
  mpm::Simulation simulation(free_bar(1.0, ramp(peak, 1e-4, 1.0), formulation));
  run_to(simulation, 1.8e-4);
  const mpm::ParticleFields& p = simulation.bodies_of<materials::Steel>()[0].get().particles;
  double momentum = 0.0, mass = 0.0;  // over the section 0.1 to 0.2 m from the base
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (p.x[i] < 0.8 || p.x[i] > 0.9) continue;
    momentum += p.mass[i] * p.velocity_x[i];
    mass += p.mass[i];
  }
  return {"particle speed behind a front of 100 MPa",
          -momentum / mass * 100e6 / peak,
          2.484790,
          1e-3,
          "m/s",
          "p/(rho c) with the bar speed",
          Tolerance::relative};
}

}  // namespace
}  // namespace mechanics

std::vector<Computation> wave_computations(scene::Formulation formulation) {
  return {{"bar wave", [formulation] {
             Checks checks = mechanics::longitudinal_pulse(formulation);
             checks.push_back(mechanics::pulse_in_a_free_bar(formulation));
             checks.push_back(mechanics::plateau_in_a_free_bar(formulation));
             return checks;
           }}};
}

std::vector<ErrorSeries> wave_series() {
  const auto of = [](const char* quantity, double mechanics::WaveError::*error) {
    return ErrorSeries{
        "bar wave",
        quantity,
        "a pulse over 0.9 m of a strip",
        "d'Alembert, relative L2",
        "",
        "uGIMP on smooth fields and the leapfrog are of second order",
        2.0,
        1e-12,
        [error] {
          return settings_for({25, 50, 100, 200, 400}, [error](int cells) {
            return with_cell(1.0 / cells, [=] {
              return mechanics::longitudinal_error(scene::Formulation::total_lagrangian, cells).*error;
            });
          });
        }};
  };
  return {of("velocity", &mechanics::WaveError::velocity), of("stress", &mechanics::WaveError::stress)};
}

}  // namespace launchsafe::verify
