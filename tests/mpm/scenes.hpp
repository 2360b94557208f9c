// Scenes of the mechanics' tests.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <numbers>

namespace launchsafe::test_support {

/// The 155 mm shell of model section 1.
inline scene::Scene shell_155(double cell_size = 2.5e-3, int particles_per_cell = 1) {
  scene::Scene shell;
  shell.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  shell.numerics.cell_size = cell_size;
  shell.numerics.particles_per_cell = particles_per_cell;
  return shell;
}

/// A steel cylinder (or strip) of the given length and radius (m).
inline scene::Scene steel_bar(double length, double radius, double cell_size, int particles_per_cell = 1) {
  scene::Scene bar;
  bar.bodies = {{"bar", "steel", 0.0, length, 0.0, radius}};
  bar.numerics.cell_size = cell_size;
  bar.numerics.particles_per_cell = particles_per_cell;
  return bar;
}

/// A pressure (Pa) that never changes.
inline scene::Load steady_pressure(double pressure, double duration = 1.0) {
  scene::Load load;
  load.duration = duration;
  load.curve_time = {0.0, duration};
  load.curve_pressure = {pressure, pressure};
  return load;
}

}  // namespace launchsafe::test_support
