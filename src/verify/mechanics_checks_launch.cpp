// Momentum, energy and frames of the assembled projectile.
#include "checks.hpp"
#include "error_settings.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "mechanics_scenes.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::verify {
namespace mechanics {
namespace {

double total_mass(const mpm::Simulation& simulation) {
  double total = 0.0;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (const double mass : p.mass) total += mass;
  });
  return total;
}

/// Axial place of the centre of mass, m.
double centre_of_mass(const mpm::Simulation& simulation) {
  double moment = 0.0;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i) moment += p.mass[i] * p.x[i];
  });
  return moment / total_mass(simulation);
}

/// Acceleration of the projectile's centre of mass under a steady 496 MPa in the lab frame, m/s2.
double measured_acceleration(scene::Formulation formulation, scene::Symmetry symmetry) {
  scene::Scene shell = shell_155(5e-3, formulation);
  shell.symmetry = symmetry;
  shell.frame = scene::Frame::lab;
  shell.load = ramp(496e6, 2e-5, 1.0);
  mpm::Simulation simulation(shell);
  run_to(simulation, 2e-5);
  const double before = simulation.axial_momentum();
  run_to(simulation, 6e-5);
  return (before - simulation.axial_momentum()) / (4e-5 * total_mass(simulation));
}

/// Steel that fills a barrel and is squeezed by it alone: sigma_rr = sigma_tt = -1.5 p, sigma_xx = 0. Its
/// particles still tile the body.
double squeeze_radially(mpm::Simulation& simulation) {
  constexpr double mu = 1e-3;
  const double pressure = materials::mie_gruneisen_pressure(simulation.scene().steel().eos, mu, 0.0);
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>()) {
    mpm::ParticleFields& p = body.particles;
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      p.volume_ratio[i] /= 1.0 + mu;
      p.mass[i] *= 1.0 + mu;
      p.pressure[i] = pressure;
      body[materials::Steel::stress_xx][i] = pressure;
      body[materials::Steel::stress_rr][i] = -0.5 * pressure;
    }
  }
  return pressure;
}

/// Largest imbalance of energy over a run, and the largest energy in it, J per radian.
struct Imbalance {
  double largest = 0, scale = 0;
  double relative() const { return largest / scale; }
};

/// The imbalance of energy in a run to `end` (s) in steps of the scene's factor.
Imbalance energy_imbalance(const scene::Scene& scene, double end) {
  mpm::Simulation simulation(scene);
  const double steps = std::ceil(end / simulation.stable_time_step());
  Imbalance imbalance;
  for (double step = 0.0; step < steps; step += 1.0) {
    simulation.step(end / steps);
    const mpm::EnergyTotals& e = simulation.energy();
    const double stored = e.kinetic + e.internal;
    imbalance.largest = std::max(imbalance.largest, std::abs(stored + e.damping - e.external - e.body_force));
    imbalance.scale = std::max(imbalance.scale, stored);
  }
  return imbalance;
}

/// The shell under a pulse of 0.2 ms, two transits of its sound.
scene::Scene pulsed_shell(scene::Formulation formulation, double cell_size) {
  scene::Scene shell = shell_155(cell_size, formulation);
  shell.load.base = 0.0;
  shell.load.peak = 100e6;
  shell.load.peak_time = 2e-4;
  return shell;
}

/// Mean axial compression of the charge's last column, Pa.
double bottom_pressure(const mpm::Simulation& simulation) {
  const mpm::Body<materials::Charge>& charge = simulation.bodies_of<materials::Charge>()[0];
  const mpm::Lattice& lattice = charge.particles.lattice;
  double force = 0.0, area = 0.0;
  for (int j = 0; j < lattice.rows(); ++j) {
    force -= lattice.r_of(j) * axial_stress(charge, lattice.slot(lattice.columns() - 1, j));
    area += lattice.r_of(j);
  }
  return force / area;
}

/// Largest difference of the charge-bottom pressure between the frames over 0.4 ms, of its largest value.
double frame_difference(scene::Formulation formulation, double pressure) {
  scene::Scene shell = shell_155(5e-3, formulation);
  shell.load = ramp(pressure, 2e-4, 1.0);
  mpm::Simulation co_moving(shell);
  shell.frame = scene::Frame::lab;
  mpm::Simulation lab(shell);
  double difference = 0.0, scale = 0.0;
  for (int k = 1; k <= 20; ++k) {
    run_to(co_moving, k * 2e-5);
    run_to(lab, k * 2e-5);
    difference = std::max(difference, std::abs(bottom_pressure(lab) - bottom_pressure(co_moving)));
    scale = std::max(scale, std::abs(bottom_pressure(co_moving)));
  }
  return difference / scale;
}

/// Changes of a block that flies freely under a uniform stress in balance: all 0 in exact arithmetic.
struct FlightDrift {
  double momentum = 0;  ///< relative
  double kinetic = 0;   ///< relative
  double stress = 0;    ///< largest axial stress over the pressure
  double work = 0;      ///< of the stress, over the kinetic energy
  double place = 0;     ///< of the centre of mass, over the way flown
};

/// A block of 50 mm flies `way` (m) through the cells, of `cell` (m), of an updated-Lagrangian grid at 500
/// m/s.
FlightDrift drift_in_flight(double cell, double way) {
  scene::Scene bar = block("steel", 0.05, 0.02, cell, scene::Formulation::updated_lagrangian);
  bar.frame = scene::Frame::lab;
  bar.load = ramp(0.0, 1e-4, 1.0);
  mpm::Simulation simulation(bar);
  const double pressure = squeeze_radially(simulation);
  constexpr double speed = 500.0;
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>())
    std::fill(body.particles.velocity_x.begin(), body.particles.velocity_x.end(), -speed);
  simulation.reset_grid();
  const double momentum = simulation.axial_momentum(), kinetic = simulation.kinetic_energy();
  const double begin = centre_of_mass(simulation);
  run_to(simulation, way / speed);
  double stress = 0.0;
  const mpm::Body<materials::Steel>& body = simulation.bodies_of<materials::Steel>()[0];
  for (std::size_t i = 0; i < body[materials::Steel::stress_xx].size(); ++i)
    if (body.particles.mass[i] > 0.0) stress = std::max(stress, std::abs(axial_stress(body, i)) / pressure);
  return {simulation.axial_momentum() / momentum - 1.0, simulation.kinetic_energy() / kinetic - 1.0, stress,
          simulation.energy().internal / kinetic, (begin - centre_of_mass(simulation)) / way - 1.0};
}

Checks rigid_acceleration(scene::Formulation formulation) {
  using enum Tolerance;
  const double round = measured_acceleration(formulation, scene::Symmetry::axisymmetric);
  const double plane = measured_acceleration(formulation, scene::Symmetry::plane_strain);
  return {{"acceleration of the 155 mm shell at 496 MPa, lab frame", round, 1.46479e5, 4e-6, "m/s2", "p A/m",
           relative},
          {"hydrostatic setback pressure of that acceleration", 1717.0 * 0.56 * round / 1e6, 140.843, 4e-6,
           "MPa", "rho L a", relative},
          {"hydrostatic setback pressure in plane strain", 1717.0 * 0.56 * plane / 1e6, 163.156, 4e-6, "MPa",
           "rho L a", relative}};
}

Checks free_flight() {
  const FlightDrift drift = drift_in_flight(2.7e-3, 1.0);
  const std::string source = "a uniform stress in balance does nothing; round-off";
  return {{"drift of the momentum over 1 m, 378 cells at 500 m/s", drift.momentum, 0.0, 1e-12, "", source},
          {"drift of the kinetic energy", drift.kinetic, 0.0, 1e-12, "", source},
          {"change of the stress, of the pressure", drift.stress, 0.0, 1e-10, "", source},
          {"work of the stress, of the kinetic energy", drift.work, 0.0, 1e-12, "", source}};
}

Checks energy_of_a_pulse(scene::Formulation formulation) {
  const std::string name =
      "imbalance of the 155 mm shell under a pulse of 100 MPa, h = 5 mm, of the largest energy";
  const double imbalance = energy_imbalance(pulsed_shell(formulation, 5e-3), 4e-4).relative();
  if (formulation == scene::Formulation::total_lagrangian)
    return {{name, imbalance, 0.0, 1e-6, "", "conservation of energy, losses of the velocity update booked"}};
  // Steel throughout, so that the waves stay smooth: what is left is what the particles' velocities lose on
  // the grid, 1/2 (sum m_i dv_i^2 - sum m_p dv_p^2) a step, of first order in the step over a given time.
  scene::Scene steel = pulsed_shell(formulation, 10e-3);
  for (scene::Body& body : steel.bodies) body.material = "steel";
  steel.numerics.time_step_factor = 0.2;
  const double coarse = energy_imbalance(steel, 4e-4).relative();
  steel.numerics.time_step_factor = 0.05;
  const double fine = energy_imbalance(steel, 4e-4).relative();
  return {{name, imbalance, 0.0, 1e-3, "", "conservation of energy"},
          {"order of the imbalance in the step, a projectile of steel", observed_order(coarse, fine, 4.0),
           1.0, 0.1, "", "loss of the velocity update, of first order"}};
}

Checks lab_against_co_moving(scene::Formulation formulation) {
  // On the lattice at rest frames differ by round-off. The grid's charge bottom lies on a line at rest and
  // inside a cell in flight.
  const bool lattice = formulation == scene::Formulation::total_lagrangian;
  return {{"charge-bottom pressure, lab against co-moving over 0.4 ms, 2 MPa: 0.04 mm of travel",
           frame_difference(formulation, 2e6), 0.0, lattice ? 1e-8 : 1e-3, "",
           "an accelerated frame with its body force"},
          {"the same at 200 MPa: 4 mm of travel, 0.8 of a cell", frame_difference(formulation, 200e6), 0.0,
           lattice ? 1e-8 : 0.03, "",
           "an accelerated frame; on a grid the place in the cell is an error of discretisation"}};
}

}  // namespace
}  // namespace mechanics

std::vector<Computation> launch_computations(scene::Formulation formulation) {
  std::vector<Computation> all{
      {"launch", [=] { return mechanics::rigid_acceleration(formulation); }},
      {"energy", [=] { return mechanics::energy_of_a_pulse(formulation); }},
      {"frames", [=] { return mechanics::lab_against_co_moving(formulation); }},
  };
  // In the total-Lagrangian form no particle leaves its cell.
  if (formulation == scene::Formulation::updated_lagrangian)
    all.push_back({"free flight", mechanics::free_flight});
  return all;
}

std::vector<ErrorSeries> flight_series() {
  const auto of = [](const char* quantity, const char* reference, double mechanics::FlightDrift::*drift) {
    return ErrorSeries{"free flight",
                       quantity,
                       "a block of 50 mm flies 0.1 m at 500 m/s",
                       reference,
                       "",
                       "exact at any mesh: a uniform velocity and a stress in balance",
                       exact_order,
                       1e-12,
                       [drift] {
                         // No length divides the block's 50 and 20 mm, so that particles cross cells at all
                         // times.
                         return settings_for({7.3e-3, 3.7e-3, 1.9e-3}, [drift](double cell) {
                           return with_cell(cell,
                                            [=] { return mechanics::drift_in_flight(cell, 0.1).*drift; });
                         });
                       }};
  };
  return {of("momentum", "kept", &mechanics::FlightDrift::momentum),
          of("kinetic energy", "kept", &mechanics::FlightDrift::kinetic),
          of("place of the centre of mass", "speed times time", &mechanics::FlightDrift::place)};
}

}  // namespace launchsafe::verify
