// Maxima over a skin history. A temperature that is not a number is never passed over: it becomes the
// maximum.
#include "launchsafe/surface/skin.hpp"

#include <cmath>
#include <limits>

namespace launchsafe::surface {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Replaces `most` by a higher temperature, or by the first one that is not a number.
void raise(Maximum& most, bool& found, const Maximum& other) {
  if (!found || (!std::isnan(most.temperature) && !(other.temperature <= most.temperature))) most = other;
  found = true;
}

/// Over the samples up to a time (s).
template <class Accept>
Maximum highest(const SkinHistory& history, Accept accept,
                double until = std::numeric_limits<double>::infinity()) {
  const std::size_t stations = history.time.empty() ? 0 : history.temperature.size() / history.time.size();
  Maximum most{not_a_number, 0.0, 0};
  bool found = false;
  for (std::size_t sample = 0; sample < history.time.size(); ++sample) {
    if (history.time[sample] > until) break;
    for (std::size_t station = 0; station < stations; ++station) {
      if (!accept(station)) continue;
      raise(most, found, {history.temperature[sample * stations + station], history.time[sample], station});
    }
  }
  return most;
}

}  // namespace

double temperature_at_time(const SkinHistory& history, const trace::BottomTrace& trace, std::size_t station,
                           double time) {
  std::vector<double> values;
  values.reserve(history.time.size());
  for (std::size_t sample = 0; sample < history.time.size(); ++sample) {
    values.push_back(history.temperature[sample * trace.stations.size() + station]);
  }
  return trace::interpolate(history.time, values, time);
}

Maximum maximum_at_stations(const SkinHistory& history, const trace::BottomTrace& trace) {
  return highest(history, [&](std::size_t station) { return !trace.stations[station].observation; });
}

Maximum maximum_at_observation_points(const SkinHistory& history, const trace::BottomTrace& trace) {
  return highest(history, [&](std::size_t station) { return trace.stations[station].observation; });
}

Maximum maximum_until(const SkinHistory& history, const trace::BottomTrace& trace, double time) {
  Maximum most = highest(
      history, [&](std::size_t station) { return !trace.stations[station].observation; }, time);
  bool found = !history.time.empty() && history.time.front() <= time;
  raise(most, found, maximum_at_time(history, trace, time));
  return most;
}

Maximum maximum_at_time(const SkinHistory& history, const trace::BottomTrace& trace, double time) {
  Maximum most{not_a_number, time, 0};
  bool found = false;
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    if (trace.stations[station].observation) continue;
    raise(most, found, {temperature_at_time(history, trace, station, time), time, station});
  }
  return most;
}

double spread_at_time(const SkinHistory& history, const trace::BottomTrace& trace, double time) {
  double least = not_a_number;
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    if (trace.stations[station].observation) continue;
    const double value = temperature_at_time(history, trace, station, time);
    if (!(least <= value)) least = value;
  }
  return maximum_at_time(history, trace, time).temperature - least;
}

}  // namespace launchsafe::surface
