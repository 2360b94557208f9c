// Scenes of the tests of contact, and what they look at.
#pragma once

#include "loads.hpp"
#include "scenes.hpp"

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace launchsafe::test_support {

/// The shell on a coarse graded lattice, under a load that is over within two milliseconds.
inline scene::Scene held_shell() {
  scene::Scene shell = shell_155(5e-3);
  shell.numerics.growth_x = 1.3;
  shell.numerics.growth_r = 1.2;
  shell.load.duration = 2e-3;
  shell.load.shape = scene::LoadShape::power_exponential;
  shell.load.peak_time = 1e-3;
  return shell;
}

inline scene::Interface sliding(const std::string& body, double friction) {
  return {.body = body, .condition = scene::Condition::sliding, .friction = friction};
}

inline void go_until(LoadedSimulation& simulation, double end) {
  while (simulation.time() < end) simulation.step(simulation.stable_time_step());
}

inline double ledger(const mpm::EnergyTotals& e) {
  return e.kinetic + e.internal + e.damping + e.contact - e.external - e.body_force;
}

/// A plain elastic material by its shear modulus (Pa), Poisson's ratio and density (kg/m3).
inline scene::Material plain(const std::string& name, double shear, double poisson, double density) {
  return {name,
          materials::LinearElastic{.density = density,
                                   .bulk = shear * 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson)),
                                   .shear = shear}};
}

inline constexpr double block_height = 0.01, block_length = 0.04, block_density = 2000.0;  // m, kg/m3

/// A block (body 1) on a floor (body 0) a million times as heavy and stiff, in plane strain: the floor rests
/// on the plane r = 0. Poisson's ratio is 0, so that a body force across makes uniform sections.
inline scene::Scene block_on_floor(scene::Interface faces) {
  scene::Scene scene;
  scene.symmetry = scene::Symmetry::plane_strain;
  scene.barrel = scene::Barrel::none;
  scene.load = steady_pressure(0.0);
  scene.materials = {plain("floor", 1e15, 0.0, 2e9), plain("block", 1e9, 0.0, block_density)};
  scene.bodies = {{"floor", "floor", 0.0, 0.1, 0.0, 0.01},
                  {"block", "block", 0.02, 0.02 + block_length, 0.01, 0.01 + block_height}};
  faces.body = "floor";
  faces.against = "block";
  scene.interfaces = {faces};
  scene.numerics.cell_size = 2.5e-3;
  return scene;
}

/// Turns the block's body force (m/s2) on in equal parts over some steps.
inline void pull_slowly(LoadedSimulation& simulation, double along, double across, int steps) {
  for (int step = 0; step < steps; ++step) {
    simulation.apply_body_force(1, along / steps, across / steps);
    simulation.step(simulation.stable_time_step());
  }
}

/// Mean velocity (m/s) of a body along x.
inline double velocity_of(const mpm::Simulation& simulation, std::size_t body) {
  const mpm::ParticleFields& p = mpm::particle_fields_of(simulation.bodies()[body]);
  const double mass = std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
  return std::inner_product(p.mass.begin(), p.mass.end(), p.velocity_x.begin(), 0.0) / mass;
}

/// Sum of the normal forces on a face, N per radian or per metre.
inline double normal_force(const std::vector<mpm::FaceState>& nodes) {
  double force = 0.0;
  for (const mpm::FaceState& node : nodes) force += node.pressure * node.area;
  return force;
}

}  // namespace launchsafe::test_support
