#include "launchsafe/surface/film_station.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::surface {

namespace {

void record(const std::vector<detail::FilmStation>& stations, const std::vector<double>& shares,
            SkinHistory& history) {
  double air = 0.0;
  for (std::size_t s = 0; s < stations.size(); ++s) {
    history.temperature.push_back(stations[s].surface());
    // A station without area does not count, whatever it has.
    if (!(shares[s] > 0.0)) continue;
    air += shares[s] * stations[s].mean_air();
    history.hottest_depth = std::max(history.hottest_depth, stations[s].hottest());
  }
  history.air_temperature.push_back(air);
}

}  // namespace

double FilmEnergy::residual() const {
  const double magnitudes = std::abs(charge) + std::abs(base) + std::abs(gas) + std::abs(work) +
                            std::abs(friction) + std::abs(reaction) + std::abs(inflow);
  const double made = charge + base + gas - work - friction - reaction - inflow;
  return magnitudes > 0.0 ? std::abs(made) / magnitudes : 0.0;
}

FilmHistory integrate_film(const SkinModel& model, const trace::BottomTrace& trace, double gap,
                           const FilmNumerics& numerics) {
  FilmHistory result;
  result.skin.gap = gap;
  result.skin.time = trace.time;
  if (trace.samples() == 0) return result;
  const detail::Intervals intervals(model, trace, gap);
  const detail::FilmGrid grid =
      detail::film_grid(model, gap, trace.time.back() - trace.time.front(), numerics);
  const std::vector<double> shares = detail::area_shares(trace);
  std::vector<detail::FilmStation> stations(
      trace.stations.size(), detail::FilmStation(model, grid, numerics, intervals.pressure_at(0),
                                                 model.surface.air.initial_pressure));
  record(stations, shares, result.skin);
  // Before anything conducts the surface is as warm as the charge, whatever air it then meets.
  std::fill(result.skin.temperature.begin(), result.skin.temperature.end(), model.initial_temperature);
  for (std::size_t interval = 0; interval < intervals.count(); ++interval) {
    const detail::IntervalPressure pressure = intervals.pressure(interval);
    for (std::size_t s = 0; s < stations.size(); ++s) {
      const bool was_ignited = stations[s].ignited();
      stations[s].advance(pressure, intervals.length(interval), intervals.friction_heating(interval, s));
      if (stations[s].ignited() && !was_ignited)
        detail::note_ignition(result.skin, trace, s, trace.time[interval] + stations[s].ignition_time(),
                              stations[s].chemical_share());
    }
    record(stations, shares, result.skin);
  }
  for (const detail::FilmStation& station : stations) {
    result.energy.push_back(station.energy());
    result.skin.energy_residual = std::fmax(result.skin.energy_residual, station.energy().residual());
  }
  return result;
}

}  // namespace launchsafe::surface
