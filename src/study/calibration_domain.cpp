#include "launchsafe/study/calibration_domain.hpp"

namespace launchsafe::study {

scene::Scene calibration_scene() {
  scene::Scene scene;
  scene.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  for (const char* body : {"nose", "wall"})
    scene.interfaces.push_back({.body = body, .condition = scene::Condition::sliding, .friction = 0.0});
  scene.load.muzzle_exit = 18e-3;  // where the published rows are read
  scene.numerics.cell_size = 1.25e-3;
  scene.numerics.growth_x = scene.numerics.growth_r = 1.3;
  scene.numerics.largest_cell = 20e-3;
  scene.numerics.time_step_factor = 0.65;
  scene.numerics.selective_inertia = 4.0;
  return scene;
}

Calibration shipped_calibration() { return {calibration_scene(), {}}; }

RecordDistance distance_to_calibration(const scene::Scene& scene, const Calibration& calibration) {
  return distance_to_record(RecordKind::calibration, scene, calibration.scene);
}

}  // namespace launchsafe::study
