// Scenes of runs through ignition.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::test_support {

inline constexpr double burning_gap = 4e-4;  // m

/// A column of charge on a base in a rigid barrel, in uniaxial strain; its skin ignites after some 0.5 ms
/// under the gap above, and burns for `duration` (s).
inline scene::Scene burning_column(double cell, double radius, double duration) {
  scene::Scene scene;
  scene.bodies = {{"charge", "charge", 0.0, 0.04, 0.0, radius}, {"base", "steel", 0.04, 0.06, 0.0, radius}};
  scene.load.duration = 1e-3;
  scene.load.peak = 200e6;
  scene.load.peak_time = 5e-3;
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.exponent = 1.0;
  scene.surface.gaps = {burning_gap};
  scene.surface.exchange_time = 5e-5;
  scene.surface.friction = scene::FrictionClosure::none;
  scene.charge().kinetics.ignition_temperature = 320.0;
  scene.numerics.cell_size = cell;
  scene.output.trace_interval = 1e-5;
  scene.coupling = scene::Coupling::two_way;
  scene.combustion.duration = duration;
  return scene;
}

}  // namespace launchsafe::test_support
