#include "mechanics_scenes.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::verify::mechanics {
namespace {

/// Place of the pulse, the centre of its momentum, m from the nose.
double centre_of_momentum(const mpm::Simulation& simulation) {
  double moment = 0.0, momentum = 0.0;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      momentum += p.mass[i] * p.velocity_x[i];
      moment += p.mass[i] * p.velocity_x[i] * p.x[i];
    }
  });
  return moment / momentum;
}

}  // namespace

scene::Scene shell_155(double cell_size, scene::Formulation formulation) {
  scene::Scene shell;
  shell.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  shell.numerics.cell_size = cell_size;
  shell.numerics.formulation = formulation;
  return shell;
}

scene::Scene block(const std::string& material, double length, double radius, double cell_size,
                   scene::Formulation formulation) {
  scene::Scene block;
  block.bodies = {{"block", material, 0.0, length, 0.0, radius}};
  block.numerics.cell_size = cell_size;
  block.numerics.formulation = formulation;
  block.load.base = 0.0;
  return block;
}

scene::Load ramp(double pressure, double rise, double duration) {
  scene::Load load;
  load.duration = duration;
  constexpr int points = 64;
  for (int k = 0; k <= points; ++k) {
    const double share = static_cast<double>(k) / points;
    load.curve_time.push_back(share * rise);
    load.curve_pressure.push_back(pressure * share * share * share * (10.0 - share * (15.0 - 6.0 * share)));
  }
  load.curve_time.push_back(duration);
  load.curve_pressure.push_back(pressure);
  return load;
}

scene::Load pulse(double peak, double peak_time) {
  scene::Load load;
  load.base = 0.0;
  load.peak = peak;
  load.peak_time = peak_time;
  load.duration = 10.0 * peak_time;
  return load;
}

double bulk_modulus(const scene::Steel& steel) {
  return steel.eos.density * steel.eos.sound_speed * steel.eos.sound_speed;
}

void make_elastic(scene::Scene& scene) { scene.steel().strength.a = 1e15; }

double run_to(mpm::Simulation& simulation, double end) {
  const double span = end - simulation.time();
  const double steps = std::ceil(span / simulation.stable_time_step());
  const double dt = span / steps;
  for (double step = 0.0; step < steps; step += 1.0) simulation.step(dt);
  return dt;
}

double speed_of_pulse(mpm::Simulation& simulation, double begin, double end) {
  run_to(simulation, begin);
  const double from = centre_of_momentum(simulation);
  run_to(simulation, end);
  return (from - centre_of_momentum(simulation)) / (end - begin);
}

double axial_stress(const mpm::Body<materials::Steel>& body, std::size_t slot) {
  return body[materials::Steel::stress_xx][slot] - body.particles.pressure[slot];
}

double axial_stress(const mpm::Body<materials::Charge>& body, std::size_t slot) {
  return body.deviator(slot).xx - body.particles.pressure[slot];
}

TemperatureRange range_of(const mpm::Simulation& simulation) {
  TemperatureRange range;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      if (!(p.mass[i] > 0.0)) continue;
      range.finite = range.finite && std::isfinite(p.temperature[i]);
      range.low = std::min(range.low, p.temperature[i]);
      range.high = std::max(range.high, p.temperature[i]);
    }
  });
  return range;
}

double step_of_fourier_number(const scene::Charge& charge, double cell, double fourier_number) {
  return fourier_number * cell * cell * charge.eos.initial_density * charge.specific_heat /
         charge.conductivity;
}

double observed_order(double coarse_error, double fine_error, double ratio) {
  return std::log(coarse_error / fine_error) / std::log(ratio);
}

}  // namespace launchsafe::verify::mechanics
