#include "launchsafe/run/judged_energy.hpp"

#include "launchsafe/scene/plan.hpp"

#include <algorithm>

namespace launchsafe::run {
namespace {

/// Pa. A hundredth of an atmosphere: it heats nothing.
constexpr double least_pressure = 1e3;

}  // namespace

double least_judged_energy(const scene::Scene& scene) {
  const double pressure = std::max(0.01 * scene::PressureHistory(scene.load).peak(), least_pressure);
  double energy = 0.0;
  for (const scene::Material& material : scene::used_materials(scene)) {
    const double speed = scene::longitudinal_speed(material.law);
    const double density = initial_density(material.law);
    energy += 0.5 * pressure * pressure * scene::mass_of(scene, material.name) /
              (density * density * speed * speed);
  }
  return energy;
}

double least_judged_impulse(const scene::Scene& scene) {
  return least_pressure * scene::base_area(scene) * scene::end_time(scene.load);
}

}  // namespace launchsafe::run
