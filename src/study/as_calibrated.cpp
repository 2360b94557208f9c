#include "launchsafe/study/as_calibrated.hpp"

#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/surface/skin.hpp"

#include <algorithm>
#include <limits>

namespace launchsafe::study {
namespace {

/// Of what heats the skin, as far as a trace holds it.
bool is_of_surface(const std::string& key) { return key.starts_with("gap.") || key.starts_with("friction."); }

void set_as_calibrated(const std::string& name, const scene::Scene& calibrated, scene::Scene& scene) {
  const auto& key = *scene::find_key(scene::scene_keys(), name);
  key.set(scene, key.get(calibrated));
}

}  // namespace

std::vector<std::string> keys_as_calibrated(const CalibrationDistance& distance) {
  std::vector<std::string> keys;
  for (const scene::Implausible& each : distance.foreign)
    if (is_of_surface(each.key)) keys.push_back(each.key);
  if (!keys.empty()) keys.insert(keys.begin(), "");
  for (const scene::Implausible& each : distance.foreign)
    if (each.key == "kinetics.ignition_temperature") keys.push_back(each.key);
  return keys;
}

bool has_foreign_surface(const CalibrationDistance& distance) {
  return std::ranges::any_of(distance.foreign, is_of_surface, &scene::Implausible::key);
}

scene::Scene with_calibrated_surface(const scene::Scene& scene, const scene::Scene& calibrated,
                                     const CalibrationDistance& distance) {
  scene::Scene changed = scene;
  for (const scene::Implausible& each : distance.foreign)
    if (is_of_surface(each.key)) set_as_calibrated(each.key, calibrated, changed);
  return changed;
}

std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const CalibrationDistance& distance, const trace::BottomTrace& trace,
                                        double gap) {
  std::vector<AsCalibrated> all;
  for (const std::string& key : keys_as_calibrated(distance)) {
    scene::Scene changed = key.empty() ? with_calibrated_surface(scene, calibrated, distance) : scene;
    if (!key.empty()) set_as_calibrated(key, calibrated, changed);
    const auto skin = surface::integrate_skin(surface::skin_model(changed), trace, gap);
    all.push_back({key, surface::maximum_at_stations(skin, trace).temperature, skin.ignition.has_value()});
  }
  return all;
}

double margin_as_calibrated(const std::vector<AsCalibrated>& all, double ignition_temperature) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const AsCalibrated& each : all)
    if (each.key.empty()) return each.ignites ? -infinity : ignition_temperature - each.temperature;
  return infinity;
}

}  // namespace launchsafe::study
