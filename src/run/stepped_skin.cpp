#include "stepped_skin.hpp"

#include <algorithm>

namespace launchsafe::run {

SteppedSkin::SteppedSkin(const scene::Scene& scene, double gap, const TraceRecorder& recorder)
    : model_(surface::skin_model(scene)),
      after_ignition_(model_),
      closure_(static_cast<std::size_t>(scene.surface.friction)) {
  after_ignition_.kinetics.ignition_temperature = model_.kinetics.burnt_temperature;
  history_.gap = gap;
  air_gap_ = scene.surface.model == scene::GapModel::closing ? 0.0 : gap;
  const std::size_t stations = recorder.trace().stations.size();
  points_.assign(stations, surface::SkinPoint{model_.initial_temperature});
  unburnt_ = points_;
  friction_.assign(stations, 0.0);
  air_pressure_ = pressure_of(recorder, scene::PressureHistory(scene.load).at(0.0));
  record(recorder);
}

void SteppedSkin::continue_from(const surface::SkinHistory& traced, const TraceRecorder& recorder,
                                double chamber_pressure) {
  history_ = traced;
  const std::size_t last = (traced.time.size() - 1) * points_.size();
  for (std::size_t s = 0; s < points_.size(); ++s) {
    points_[s] = unburnt_[s] = surface::SkinPoint{traced.temperature[last + s]};
    if (closure_ < trace::traced_closures) friction_[s] = recorder.friction(closure_, s);
  }
  air_pressure_ = pressure_of(recorder, chamber_pressure);
}

void SteppedSkin::advance(const mpm::Simulation& simulation, const TraceRecorder& recorder, double dt) {
  const double begin = materials::adiabatic_temperature(model_.surface.air, air_pressure_);
  air_pressure_ = pressure_of(recorder, simulation.chamber_pressure());
  const double end = materials::adiabatic_temperature(model_.surface.air, air_pressure_);
  for (std::size_t s = 0; s < points_.size(); ++s) {
    const double friction = heating(recorder, s, dt);
    surface::SkinPoint& point = points_[s];
    if (point.ignited) {
      unburnt_[s] = surface::advance_skin(after_ignition_, air_gap_, unburnt_[s], dt, begin, end, friction);
      point = surface::advance_skin(model_, air_gap_, point, dt, begin, end, friction);
      continue;
    }
    point = surface::advance_skin(model_, air_gap_, point, dt, begin, end, friction);
    unburnt_[s] = point;
    if (!point.ignited) continue;
    unburnt_[s].temperature =
        std::min(model_.kinetics.ignition_temperature, model_.kinetics.burnt_temperature);
    unburnt_[s].ignited = false;
    note_ignition(recorder, s, simulation.time() - dt + point.ignition_time);
  }
}

void SteppedSkin::record(const TraceRecorder& recorder) {
  history_.time.push_back(recorder.trace().time.back());
  history_.air_temperature.push_back(materials::adiabatic_temperature(model_.surface.air, air_pressure_));
  for (const surface::SkinPoint& point : points_) history_.temperature.push_back(point.temperature);
}

double SteppedSkin::pressure_of(const TraceRecorder& recorder, double chamber) const {
  return model_.surface.air_pressure == scene::AirPressure::chamber ? chamber : recorder.bottom_pressure();
}

double SteppedSkin::heating(const TraceRecorder& recorder, std::size_t station, double dt) {
  if (closure_ >= trace::traced_closures) return 0.0;
  const double before = friction_[station];
  friction_[station] = recorder.friction(closure_, station);
  return (friction_[station] - before) * model_.surface.localisation /
         (model_.charge_density * model_.specific_heat * dt);
}

void SteppedSkin::note_ignition(const TraceRecorder& recorder, std::size_t station, double time) {
  const double share = points_[station].chemical_share;
  const auto cause = share > 0.5 ? surface::IgnitionCause::arrhenius : surface::IgnitionCause::trigger;
  if (!recorder.trace().stations[station].observation && !history_.ignition)
    history_.ignition = surface::Ignition{time, station, cause, share};
}

}  // namespace launchsafe::run
