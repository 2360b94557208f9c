#include "launchsafe/surface/skin.hpp"

#include "launchsafe/math/statistics.hpp"
#include "launchsafe/surface/skin_equation.hpp"

#include <numeric>

namespace launchsafe::surface {

using math::all_finite;

namespace {

/// The skin equation of an interval, but for the friction of a station.
detail::SkinEquation equation_of(const SkinModel& model, const detail::Intervals& intervals,
                                 std::size_t interval) {
  const detail::LinearAir air = detail::linear_air(model.surface.air, intervals.pressure(interval));
  detail::SkinEquation equation;
  equation.exchange_rate = intervals.exchange_rate();
  equation.air = air.begin;
  equation.air_slope = (air.end - air.begin) / intervals.length(interval);
  return equation;
}

/// Of stations, K/s.
std::vector<double> heating_of(const detail::Intervals& intervals, std::size_t interval,
                               const std::vector<std::size_t>& stations) {
  std::vector<double> heating;
  for (const std::size_t station : stations) heating.push_back(intervals.friction_heating(interval, station));
  return heating;
}

/// K/s times intervals, by friction over the launch; 0 where that is no number.
double whole_heating(const detail::Intervals& intervals, std::size_t station) {
  double whole = 0.0;
  for (std::size_t i = 0; i < intervals.count(); ++i) whole += intervals.friction_heating(i, station);
  return std::isfinite(whole) ? whole : 0.0;
}

/// The stations that tile the bottom, but for those which friction heats in no interval more than another
/// one; first what friction heats most.
std::vector<std::size_t> hottest_stations(const detail::Intervals& intervals,
                                          const trace::BottomTrace& trace) {
  const auto is_as_hot = [&](std::size_t station, std::size_t other) {
    for (std::size_t i = 0; i < intervals.count(); ++i)
      if (!(intervals.friction_heating(i, station) >= intervals.friction_heating(i, other))) return false;
    return true;
  };
  std::vector<std::pair<double, std::size_t>> hottest;  // minus the whole heating
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    if (trace.stations[station].observation) continue;
    if (std::ranges::any_of(hottest, [&](auto other) { return is_as_hot(other.second, station); })) continue;
    std::erase_if(hottest, [&](auto other) { return is_as_hot(station, other.second); });
    hottest.emplace_back(-whole_heating(intervals, station), station);
  }
  std::ranges::sort(hottest);
  std::vector<std::size_t> stations;
  for (const auto& each : hottest) stations.push_back(each.second);
  return stations;
}

// --- maxima: a temperature that is not a number is never passed over, it becomes the maximum ---

/// Replaces `most` by a higher temperature, or by the first one that is not a number.
void raise(std::optional<Maximum>& most, const Maximum& other) {
  if (!most || (!std::isnan(most->temperature) && !(other.temperature <= most->temperature))) most = other;
}

/// Over the samples up to a time (s), of the observation points or of all other stations.
std::optional<Maximum> highest(const SkinHistory& history, const trace::BottomTrace& trace, bool observation,
                               double until = math::infinity) {
  const std::size_t stations = history.time.empty() ? 0 : history.temperature.size() / history.time.size();
  std::optional<Maximum> most;
  for (std::size_t sample = 0; sample < history.time.size() && !(history.time[sample] > until); ++sample)
    for (std::size_t s = 0; s < stations; ++s)
      if (trace.stations[s].observation == observation)
        raise(most, {history.temperature[sample * stations + s], history.time[sample], s});
  return most;
}

}  // namespace

SkinModel skin_model(const scene::Scene& scene) {
  SkinModel model;
  model.surface = scene.surface;
  model.kinetics = scene.charge().kinetics;
  model.charge_density = scene.charge().density;
  model.specific_heat = scene.charge().specific_heat;
  model.conductivity = scene.charge().conductivity;
  model.initial_temperature = scene.initial_temperature;
  return model;
}

double heat_capacity_ratio(const SkinModel& model, double gap) {
  const scene::Surface& s = model.surface;
  return s.air.density * gap * s.air.specific_heat /
         (model.charge_density * s.skin_thickness * model.specific_heat);
}

SkinHistory integrate_skin(const SkinModel& model, const trace::BottomTrace& trace, double gap) {
  const detail::Intervals intervals(model, trace, gap);
  const std::size_t stations = trace.stations.size();
  std::vector<std::size_t> all_stations(stations);
  std::iota(all_stations.begin(), all_stations.end(), std::size_t{0});
  SkinHistory history;
  history.gap = gap;
  history.time = trace.time;
  history.temperature.assign(trace.samples() * stations, model.initial_temperature);
  for (std::size_t sample = 0; sample < trace.samples(); ++sample)
    history.air_temperature.push_back(
        materials::adiabatic_temperature(model.surface.air, intervals.pressure_at(sample)));
  std::vector<SkinPoint> points(stations, SkinPoint{model.initial_temperature});
  std::vector<bool> was_ignited(stations, false);
  for (std::size_t interval = 0; interval < intervals.count(); ++interval) {
    detail::advance(model, equation_of(model, intervals, interval),
                    heating_of(intervals, interval, all_stations), points, intervals.length(interval));
    for (std::size_t station = 0; station < stations; ++station) {
      const SkinPoint& point = points[station];
      history.temperature[(interval + 1) * stations + station] = point.temperature;
      if (point.ignited && !was_ignited[station] && !trace.stations[station].observation)
        history.note_ignition(station, trace.time[interval] + point.ignition_time, point.chemical_share);
      was_ignited[station] = point.ignited;
    }
  }
  if (!all_finite(history.temperature) || !all_finite(history.air_temperature)) history.ignition.reset();
  return history;
}

IgnitionOfGaps::IgnitionOfGaps(SkinModel model, const trace::BottomTrace& trace)
    : model_(std::move(model)), trace_(trace) {
  const detail::Intervals intervals(model_, trace, 0.0);
  const std::vector<std::size_t> hottest = hottest_stations(intervals, trace);
  stations_ = hottest.size();
  for (std::size_t interval = 0; interval < intervals.count(); ++interval) {
    const detail::SkinEquation equation = equation_of(model_, intervals, interval);
    intervals_.push_back({equation.air, equation.air_slope, heating_of(intervals, interval, hottest)});
    all_finite_ = all_finite_ && all_finite(intervals_.back().heating);
  }
}

std::optional<bool> IgnitionOfGaps::operator()(double gap) const {
  if (trace_.samples() == 0 || trace_.stations.empty() || !all_finite_) return std::nullopt;
  const detail::Intervals intervals(model_, trace_, gap);
  for (std::size_t first = 0; first < stations_; first += math::pack_width) {
    const auto ignites = any_ignites(intervals, first, std::min(math::pack_width, stations_ - first));
    if (!ignites || *ignites) return ignites;
  }
  return false;
}

std::optional<bool> IgnitionOfGaps::any_ignites(const detail::Intervals& intervals, std::size_t first,
                                                std::size_t count) const {
  std::vector<SkinPoint> points(count, SkinPoint{model_.initial_temperature});
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const Interval& interval = intervals_[i];
    const detail::SkinEquation equation{intervals.exchange_rate(), interval.air, interval.air_slope, 0.0};
    detail::advance(model_, equation, std::span(interval.heating).subspan(first, count), points,
                    intervals.length(i));
    const auto is_finite = [](const SkinPoint& point) { return std::isfinite(point.temperature); };
    if (!std::ranges::all_of(points, is_finite)) return std::nullopt;
    if (std::ranges::any_of(points, &SkinPoint::ignited)) return true;
  }
  return false;
}

SkinPoint advance_skin(const SkinModel& model, double gap, SkinPoint point, double dt, double air_begin,
                       double air_end, double friction_heating) {
  const double ratio = heat_capacity_ratio(model, gap);
  detail::SkinEquation equation;
  equation.exchange_rate = ratio / model.surface.exchange_time;
  equation.air = air_begin;
  equation.air_slope = (air_end - air_begin) / dt;
  equation.heating = friction_heating;
  return detail::advance(model, equation, point, dt);
}

void SkinHistory::note_ignition(std::size_t station, double at, double chemical_share) {
  const IgnitionCause cause = chemical_share > 0.5 ? IgnitionCause::arrhenius : IgnitionCause::trigger;
  if (!ignition || at < ignition->time) ignition = Ignition{at, station, cause, chemical_share};
}

double temperature_at_time(const SkinHistory& history, const trace::BottomTrace& trace, std::size_t station,
                           double time) {
  std::vector<double> values;
  for (std::size_t sample = 0; sample < history.time.size(); ++sample)
    values.push_back(history.temperature[sample * trace.stations.size() + station]);
  return trace::interpolate(history.time, values, time);
}

Maximum maximum_at_stations(const SkinHistory& history, const trace::BottomTrace& trace) {
  return highest(history, trace, false).value_or(Maximum{math::not_a_number});
}

Maximum maximum_at_observation_points(const SkinHistory& history, const trace::BottomTrace& trace) {
  return highest(history, trace, true).value_or(Maximum{math::not_a_number});
}

Maximum maximum_until(const SkinHistory& history, const trace::BottomTrace& trace, double time) {
  std::optional<Maximum> most = highest(history, trace, false, time);
  raise(most, maximum_at_time(history, trace, time));
  return *most;
}

Maximum maximum_at_time(const SkinHistory& history, const trace::BottomTrace& trace, double time) {
  std::optional<Maximum> most;
  for (std::size_t station = 0; station < trace.stations.size(); ++station)
    if (!trace.stations[station].observation)
      raise(most, {temperature_at_time(history, trace, station, time), time, station});
  return most.value_or(Maximum{math::not_a_number, time});
}

double spread_at_time(const SkinHistory& history, const trace::BottomTrace& trace, double time) {
  double least = math::not_a_number;
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    if (trace.stations[station].observation) continue;
    const double value = temperature_at_time(history, trace, station, time);
    if (!(least <= value)) least = value;
  }
  return maximum_at_time(history, trace, time).temperature - least;
}

// --- the energy of the air ---

namespace {

/// Heat (K of the skin) that neither friction nor reaction brought to one station.
class HeatFromOutside {
 public:
  HeatFromOutside(const SkinModel& model, const detail::Intervals& intervals, std::size_t station)
      : model_(model), intervals_(intervals), trigger_(detail::trigger_of(model)), station_(station) {}

  /// Over the first `length` seconds of an interval, from one temperature (K) to another.
  double between(std::size_t interval, double length, double begin, double end) const {
    const double middle = 0.5 * (begin + end);
    const double reaction = (rate(begin) + 4.0 * rate(middle) + rate(end)) / 6.0;
    return unreleased(end) - unreleased(begin) -
           (intervals_.friction_heating(interval, station_) + reaction) * length;
  }

  /// Temperature (K) at which a solid turns into a burning one.
  double at_ignition() const {
    return trigger_.immediate ? trigger_.temperature : model_.kinetics.burnt_temperature;
  }

 private:
  bool releases(double temperature) const {
    return !trigger_.immediate && temperature > trigger_.temperature;
  }
  /// Temperature less the heat that lambda released on the way to it.
  double unreleased(double temperature) const {
    if (!releases(temperature)) return temperature;
    return trigger_.temperature + (temperature - trigger_.temperature) / trigger_.amplification;
  }
  /// Of the Arrhenius reaction, K/s.
  double rate(double temperature) const {
    const materials::KineticsParameters& k = model_.kinetics;
    const double whole = materials::arrhenius_heating(k, model_.specific_heat, temperature);
    if (!releases(temperature)) return whole;
    const double left = (k.burnt_temperature - temperature) / (k.burnt_temperature - k.ignition_temperature);
    return std::clamp(left, 0.0, 1.0) * whole;
  }

  const SkinModel& model_;
  const detail::Intervals& intervals_;
  detail::Trigger trigger_;
  std::size_t station_;
};

double end_of(const SkinHistory& history) {
  return history.ignition ? history.ignition->time : history.time.back();
}

bool belongs(const SkinHistory& history, const trace::BottomTrace& trace) {
  return trace.samples() > 0 && history.time.size() == trace.samples() &&
         history.temperature.size() == trace.samples() * trace.stations.size() &&
         math::all_finite(history.temperature);
}

}  // namespace

double heat_taken(const SkinModel& model, const trace::BottomTrace& trace, const SkinHistory& history) {
  const detail::Intervals intervals(model, trace, history.gap);
  const std::size_t stations = trace.stations.size();
  const std::size_t station =
      history.ignition ? history.ignition->station : maximum_at_stations(history, trace).station;
  const HeatFromOutside heat(model, intervals, station);
  const double end = end_of(history);
  double sum = 0.0, most = 0.0;  // K
  for (std::size_t interval = 0; interval < intervals.count() && trace.time[interval] < end; ++interval) {
    const double from = history.temperature[interval * stations + station];
    const bool ignites = history.ignition && trace.time[interval + 1] >= end;
    const double to = ignites ? std::max(from, heat.at_ignition())
                              : history.temperature[(interval + 1) * stations + station];
    const double length = ignites ? end - trace.time[interval] : intervals.length(interval);
    sum += heat.between(interval, length, from, to);
    most = std::max(most, sum);
  }
  return model.charge_density * model.specific_heat * model.surface.skin_thickness * most;
}

double compression_supply(const SkinModel& model, const trace::BottomTrace& trace, double gap, double end) {
  const materials::AirParameters& air = model.surface.air;
  const detail::Intervals intervals(model, trace, gap);
  double rises = std::max(0.0, air.initial_temperature - model.initial_temperature);  // K
  double before = air.initial_temperature;
  for (std::size_t sample = 0; sample < trace.samples() && trace.time[sample] <= end; ++sample) {
    const double now = materials::adiabatic_temperature(air, intervals.pressure_at(sample));
    rises += std::max(0.0, now - before);
    before = now;
  }
  return air.density * gap * air.specific_heat * rises;
}

AirEnergy audit_air(const SkinModel& model, const trace::BottomTrace& trace, const SkinHistory& history) {
  if (!belongs(history, trace)) return {};
  if (!(history.gap > 0.0)) return {0.0, 0.0};
  return {heat_taken(model, trace, history), compression_supply(model, trace, history.gap, end_of(history))};
}

}  // namespace launchsafe::surface
