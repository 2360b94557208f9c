#pragma once

#include "launchsafe/surface/skin.hpp"

#include <cmath>
#include <string>

namespace launchsafe::surface {

/// A model with round constants of its own, so that tests do not move when the calibrated defaults do.
inline SkinModel plain_model() {
  SkinModel model;
  model.surface.localisation = 300.0;
  model.surface.exchange_time = 3.6e-4;
  model.kinetics.ignition_temperature = 525.0;
  return model;
}

inline constexpr double friction_energy = 1.1e6;  // J/m3: 108 K at a localisation of 300

/// A launch with the default load on the charge bottom and friction that grows with t^3 to `friction` J/m3.
inline trace::BottomTrace smooth_launch(int intervals, int rows, double friction) {
  trace::BottomTrace trace;
  trace.stations = {{"G1", 0.6775, 0.0625, 0.0, true}, {"G13", 0.6775, 0.0025, 0.0, true}};
  for (int row = 0; row < rows; ++row) {
    trace.stations.push_back({"row " + std::to_string(row), 0.6775, 0.001 * row, 1e-4 * (row + 1), false});
  }
  const auto pressure = [](double t) {
    return 101325.0 + 140e6 * std::pow(t / 11e-3 * std::exp(1.0 - t / 11e-3), 12.0);
  };
  for (int sample = 0; sample <= intervals; ++sample) {
    const double dt = 18e-3 / intervals, t = dt * sample;
    double mean = 0.0;
    for (int k = 0; k < 64; ++k) mean += pressure(t - dt * (k + 0.5) / 64.0) / 64.0;
    if (sample == 0) mean = pressure(0.0);
    trace.time.push_back(t);
    for (auto* values : {&trace.bottom_pressure, &trace.chamber_pressure}) values->push_back(pressure(t));
    trace.mean_bottom_pressure.push_back(mean);
    for (std::size_t station = 0; station < trace.stations.size(); ++station) {
      const double share =
          1.0 - 0.2 * static_cast<double>(station) / static_cast<double>(trace.stations.size());
      trace.friction.push_back(share * friction * std::pow(t / 18e-3, 3.0));
    }
  }
  return trace;
}

}  // namespace launchsafe::surface
