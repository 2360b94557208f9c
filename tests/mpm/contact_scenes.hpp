// Scenes of the tests of contact, and what they look at.
#pragma once

#include "loads.hpp"
#include "scenes.hpp"

#include <cmath>
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

inline double ledger(const mpm::EnergyBalance& e) {
  return e.kinetic + e.internal + e.damping + e.contact - e.external - e.body_force;
}

/// A plain elastic material by its shear modulus (Pa), Poisson's ratio and density (kg/m3).
inline scene::Material plain(const std::string& name, double shear, double poisson, double density) {
  return {name,
          materials::LinearElastic{.density = density,
                                   .bulk = shear * 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson)),
                                   .shear = shear}};
}

/// Sum of the normal forces on a face, N per radian.
inline double normal_force(const std::vector<mpm::FaceState>& nodes) {
  double force = 0.0;
  for (const mpm::FaceState& node : nodes) force += node.pressure * node.area;
  return force;
}

}  // namespace launchsafe::test_support
