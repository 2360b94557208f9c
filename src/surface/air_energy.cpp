#include "launchsafe/surface/air_energy.hpp"

#include "launchsafe/math/statistics.hpp"
#include "launchsafe/surface/skin_equation.hpp"

namespace launchsafe::surface {
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

/// Highest pressure (Pa) on the air until a time (s).
double highest_pressure(const detail::Intervals& intervals, const trace::BottomTrace& trace, double end) {
  double highest = intervals.pressure_at(0);
  for (std::size_t sample = 1; sample < trace.samples() && trace.time[sample] <= end; ++sample)
    highest = std::max(highest, intervals.pressure_at(sample));
  return highest;
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
  if (!(history.gap > 0.0)) return {0.0, 0.0, 0.0, 0.0};
  const materials::AirParameters& air = model.surface.air;
  const double end = end_of(history);
  const double highest = std::max(air.initial_pressure,
                                  highest_pressure(detail::Intervals(model, trace, history.gap), trace, end));
  AirEnergy energy;
  energy.taken = heat_taken(model, trace, history);
  energy.supplied = compression_supply(model, trace, history.gap, end);
  energy.stored = air.density * history.gap * air.specific_heat / air.heat_ratio *
                  (materials::adiabatic_temperature(air, highest) - air.initial_temperature);
  energy.isothermal = air.initial_pressure * history.gap * std::log(highest / air.initial_pressure);
  return energy;
}

}  // namespace launchsafe::surface
