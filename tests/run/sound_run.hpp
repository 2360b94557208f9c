// A sound run of the shipped scene, and what judges warnings about others.
#pragma once

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace launchsafe::run::test_support {

/// With true inertia.
inline scene::Scene shipped_scene() {
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").scene;
  scene.numerics.selective_inertia = 1.0;
  return scene;
}

/// The shipped load in a barrel without end.
inline void take_exit(scene::Load& load) { load = scene::without_exit(load); }

/// A sound run of the shipped scene, made by hand; energies as measured on cells of 2.5 mm.
inline MechanicsResult sound_run() {
  MechanicsResult run;
  run.end_time = 18e-3;
  run.trace.stations = {{"S1", 0.678, 0.0625, 0.01, false}};
  for (int i = 0; i <= 900; ++i) {
    run.trace.time.push_back(2e-5 * i);
    run.trace.chamber_pressure.push_back(496e6 * i / 900.0);
    run.trace.bottom_pressure.push_back(0.99 * 140.843e6 * i / 900.0);
    run.trace.friction.push_back(180.0 * i);
  }
  run.monitor.resize(3);
  for (MonitorSample& sample : run.monitor) sample.largest_crack_radius = 30e-6;
  run.monitor[1].energy.internal = 7470.0;
  run.monitor[1].energy.kinetic = 18.7;
  run.monitor[2].largest_plastic_strain = 5e-3;
  return run;
}

}  // namespace launchsafe::run::test_support
