#include "exact_solutions.hpp"

#include "launchsafe/mpm/conduction.hpp"
#include "support/mie_gruneisen_pressure.hpp"

namespace launchsafe::test_support {

std::string name_of(scene::Formulation formulation) {
  return formulation == scene::Formulation::total_lagrangian ? "TotalLagrangian" : "UpdatedLagrangian";
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
  load.shape = scene::LoadShape::power_exponential;
  load.peak_time = peak_time;
  load.duration = 10.0 * peak_time;
  return load;
}

double bulk_modulus(const scene::Steel& steel) {
  return steel.eos.density * steel.eos.sound_speed * steel.eos.sound_speed;
}

double compress(mpm::Simulation& simulation, double mu) {
  const double pressure = mie_gruneisen_pressure(simulation.scene().steel().eos, mu, 0.0);
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>()) {
    mpm::ParticleFields& p = body.particles;
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      p.volume_ratio[i] /= 1.0 + mu;
      p.mass[i] *= 1.0 + mu;
      p.pressure[i] = pressure;
    }
  }
  simulation.reset_grid();
  return pressure;
}

double run_to(mpm::Simulation& simulation, double end, const std::function<void()>& before_step) {
  const double span = end - simulation.time();
  const double steps = std::ceil(span / simulation.stable_time_step());
  const double dt = span / steps;
  for (double step = 0.0; step < steps; step += 1.0) {
    if (before_step) before_step();
    simulation.step(dt);
  }
  return dt;
}

// v = -p(t - (L - X)/c)/(rho c) less the velocity of the frame, sigma = -p(t - (L - X)/c). After a step the
// velocity is that of its middle. It is compared as the mean of two neighbours, which is what their node
// sees: the alternating part of the particles' velocities (1e-3 of the peak here) is invisible to the grid
// and acts on nothing. The load is small (strains of 1e-7), so that the laws are linear.
WaveError longitudinal_error(scene::Formulation formulation, int cells) {
  const double length = 1.0;
  scene::Scene strip = block("steel", length, 2.0 / cells, length / cells, formulation);
  const scene::Steel& steel = strip.steel();
  const double density = steel.eos.density;
  const double wave_speed =
      std::sqrt((bulk_modulus(steel) + 4.0 / 3.0 * steel.strength.shear_modulus) / density);
  const double peak_time = 0.5 * length / wave_speed;
  strip.load = pulse(1e5, peak_time);
  mpm::Simulation simulation(strip);
  const double dt = run_to(simulation, 1.8 * peak_time);
  const scene::PressureHistory pressure(strip.load);
  const double of_frame = scene::rigid_motion(strip, simulation.time() - 0.5 * dt).velocity;
  const mpm::Body<materials::Steel>& body = simulation.bodies_of<materials::Steel>()[0];
  const mpm::Lattice& lattice = body.particles.lattice;
  RelativeError velocity, stress;
  for (int i = 0; i + 1 < lattice.columns(); ++i) {
    const std::size_t slot = lattice.slot(i, 0), next = lattice.slot(i + 1, 0);
    const double node = 0.5 * (lattice.x_of(i) + lattice.x_of(i + 1));
    const double at_node = simulation.time() - 0.5 * dt - (length - node) / wave_speed;
    velocity.add(0.5 * (body.particles.velocity_x[slot] + body.particles.velocity_x[next]),
                 of_frame - pressure.at(at_node) / (density * wave_speed));
    const double at_particle = simulation.time() - (length - lattice.x_of(i)) / wave_speed;
    stress.add(axial_stress(body, slot), -pressure.at(at_particle));
  }
  return {velocity.value(), stress.value()};
}

scene::Scene half_space(double cell) { return block("charge", half_space_depth, cell, cell); }

double half_space_error(double cell, int steps) {
  scene::Scene halves = half_space(cell);
  halves.bodies[0].x_end *= 2.0;
  mpm::Simulation simulation(halves);
  mpm::Conduction conduction(simulation);
  const double initial = halves.initial_temperature;
  mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  for (std::size_t i = 0; i < p.x.size(); ++i)
    if (p.x[i] > half_space_depth) p.temperature[i] += 2.0;  // between both, 1 K
  for (int step = 0; step < steps; ++step) conduction.advance(simulation, half_space_duration / steps);
  const scene::Charge& charge = simulation.scene().charge();
  const double diffusivity = charge.conductivity / (charge.density * charge.specific_heat);
  RelativeError error;
  for (int i = 0; i < p.lattice.columns() / 2; ++i) {
    const double depth = half_space_depth - p.lattice.x_of(i);
    error.add(p.temperature[p.lattice.slot(i, 0)] - initial,
              std::erfc(depth / (2.0 * std::sqrt(diffusivity * half_space_duration))));
  }
  return error.value();
}

}  // namespace launchsafe::test_support
