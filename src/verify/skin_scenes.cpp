#include "skin_scenes.hpp"

#include <algorithm>
#include <utility>

namespace launchsafe::verify {

surface::SkinModel inert_skin(double exchange_time) {
  surface::SkinModel model;
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
  model.surface.friction = scene::FrictionClosure::none;
  model.surface.exchange_time = exchange_time;
  return model;
}

surface::SkinModel inert_film() {
  surface::SkinModel model = inert_skin(scene::Surface{}.exchange_time);
  model.surface.air_model = scene::AirModel::film;
  return model;
}

PressureOfInterval with_integral(FunctionOfTime pressure, FunctionOfTime integral) {
  return [pressure = std::move(pressure), integral = std::move(integral)](double begin, double end) {
    const double value = pressure(end);
    return PressureSample{value, end > begin ? (integral(end) - integral(begin)) / (end - begin) : value};
  };
}

trace::BottomTrace pressed_bottom(std::vector<trace::Station> stations, int intervals, double duration,
                                  const PressureOfInterval& pressure) {
  trace::BottomTrace trace;
  trace.stations = std::move(stations);
  for (int sample = 0; sample <= intervals; ++sample) {
    const double end = duration * sample / intervals;
    const PressureSample interval = pressure(duration * std::max(0, sample - 1) / intervals, end);
    trace.time.push_back(end);
    trace.steps.push_back(sample);
    for (auto* values : {&trace.bottom_pressure, &trace.chamber_pressure}) values->push_back(interval.end);
    for (auto* values : {&trace.mean_bottom_pressure, &trace.mean_chamber_pressure})
      values->push_back(interval.mean);
    for (auto& closure : trace.friction) closure.insert(closure.end(), trace.stations.size(), 0.0);
  }
  return trace;
}

}  // namespace launchsafe::verify
