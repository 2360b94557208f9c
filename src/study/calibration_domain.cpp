#include "launchsafe/study/calibration_domain.hpp"

#include "launchsafe/study/firing_posterior.hpp"

#include <algorithm>
#include <limits>

namespace launchsafe::study {
namespace {

constexpr double round_off_of_units = 1e-9;

/// Whether a number lies within those of the firings.
bool is_between(double value, const std::vector<Firing>& firings, double Firing::*number) {
  const auto [lowest, highest] = std::ranges::minmax_element(firings, {}, number);
  return lowest != firings.end() && value >= (*lowest).*number * (1.0 - round_off_of_units) &&
         value <= (*highest).*number * (1.0 + round_off_of_units);
}

}  // namespace

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

double fired_pressure(const scene::Load& load) {
  const bool is_scaled = load.curve_time.empty() || load.rescale_to_peak;
  return is_scaled ? load.peak : scene::PressureHistory(load).stated_peak();
}

double calibrated_gap(const std::vector<Firing>& firings, double pressure, double temperature) {
  const auto at_least = [](double value, double other) {
    return value >= other * (1.0 - round_off_of_units);
  };
  double ignites = std::numeric_limits<double>::infinity();
  for (const Firing& each : firings)
    if (each.ignited && at_least(pressure, each.pressure) && at_least(temperature, each.temperature))
      ignites = std::min(ignites, each.gap);
  const auto is_as_severe = [&](const Firing& each) {
    return !each.ignited && at_least(each.pressure, pressure) && at_least(each.temperature, temperature) &&
           each.gap < ignites;
  };
  double largest = -1.0;
  for (const Firing& candidate : firings) {
    int rounds = 0;
    for (const Firing& each : firings)
      if (is_as_severe(each) && each.gap >= candidate.gap) rounds += each.rounds;
    if (is_as_severe(candidate) && rounds >= fewest_rounds) largest = std::max(largest, candidate.gap);
  }
  return largest;
}

double calibrated_gap(const Calibration& calibration, const scene::Scene& scene) {
  if (!calibration.firings) return calibration.evidence.largest_gap;
  return calibrated_gap(calibration.firings->firings, fired_pressure(scene.load), scene.initial_temperature);
}

RecordDistance distance_to_calibration(const scene::Scene& scene, const Calibration& calibration) {
  if (!calibration.firings) return distance_to_record(RecordKind::calibration, scene, calibration.scene);
  scene::Scene recorded = calibration.scene;
  const std::vector<Firing>& firings = calibration.firings->firings;
  const double pressure = fired_pressure(scene.load);
  if (is_between(pressure, firings, &Firing::pressure)) recorded.load.peak = scene.load.peak;
  // The air of the gap has the temperature of the charge.
  recorded.surface.air =
      materials::warmed(recorded.surface.air, scene.initial_temperature - recorded.initial_temperature);
  if (is_between(scene.initial_temperature, firings, &Firing::temperature))
    recorded.initial_temperature = scene.initial_temperature;
  return distance_to_record(RecordKind::firings, scene, recorded);
}

}  // namespace launchsafe::study
