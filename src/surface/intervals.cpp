#include "intervals.hpp"

#include <cmath>
#include <limits>

namespace launchsafe::surface::detail {

namespace {

const std::vector<double>* friction_of(const SkinModel& model, const trace::BottomTrace& trace) {
  const auto closure = static_cast<std::size_t>(model.surface.friction);
  return closure < trace::traced_closures ? &trace.friction[closure] : nullptr;
}

bool from_chamber(const SkinModel& model) {
  return model.surface.air_pressure == scene::AirPressure::chamber;
}

}  // namespace

LinearAir linear_air(const materials::AirParameters& air, const IntervalPressure& pressure) {
  const double begin = materials::adiabatic_temperature(air, pressure.begin);
  const double end = materials::adiabatic_temperature(air, pressure.end);
  const double at_mean = materials::adiabatic_temperature(air, pressure.mean);
  // Mean of T(p) over a nearly linear p: T(mean) + T''(mean) (p1 - p0)^2/24, with T'' = a (a - 1) T/p^2.
  const double a = (air.heat_ratio - 1.0) / air.heat_ratio;
  // Below the initial pressure the temperature is constant, and a mean of 0 has no relative spread.
  const double spread =
      pressure.mean > air.initial_pressure ? (pressure.end - pressure.begin) / pressure.mean : 0.0;
  const double curved = at_mean * (1.0 + a * (a - 1.0) * spread * spread / 24.0);
  const double mean = curved < air.initial_temperature ? air.initial_temperature : curved;
  // Not steeper than keeps both ends at or above the initial temperature.
  const double steepest = mean - air.initial_temperature;
  double half = 0.5 * (end - begin);
  if (half > steepest) half = steepest;
  if (half < -steepest) half = -steepest;
  return {mean - half, mean + half};
}

Intervals::Intervals(const SkinModel& model, const trace::BottomTrace& trace, double gap)
    : model_(model),
      trace_(trace),
      pressure_(from_chamber(model) ? trace.chamber_pressure : trace.bottom_pressure),
      mean_(from_chamber(model) ? trace.mean_chamber_pressure : trace.mean_bottom_pressure),
      friction_(friction_of(model, trace)),
      ratio_(heat_capacity_ratio(model, gap)),
      rate_of_step_(per_step_rate(ratio_, 1.0, 1.0)) {}

IntervalPressure Intervals::pressure(std::size_t interval) const {
  return {pressure_[interval], pressure_[interval + 1], mean_[interval + 1]};
}

double Intervals::exchange_rate(std::size_t interval) const {
  if (model_.surface.exchange == scene::Exchange::per_step) {
    return rate_of_step_ * (trace_.steps[interval + 1] - trace_.steps[interval]) / length(interval);
  }
  return ratio_ / model_.surface.exchange_time;
}

double Intervals::friction_heating(std::size_t interval, std::size_t station) const {
  if (friction_ == nullptr) return 0.0;
  const std::size_t stations = trace_.stations.size();
  if (friction_->size() != stations * trace_.samples()) return std::numeric_limits<double>::quiet_NaN();
  const double energy =
      (*friction_)[(interval + 1) * stations + station] - (*friction_)[interval * stations + station];
  return energy * model_.surface.localisation /
         (model_.charge_density * model_.specific_heat * length(interval));
}

double per_step_rate(double ratio, double steps, double length) {
  return -std::log1p(-ratio) * steps / length;
}

std::vector<double> area_shares(const trace::BottomTrace& trace) {
  double total = 0.0;
  for (const trace::Station& station : trace.stations) total += station.area;
  std::vector<double> shares;
  for (const trace::Station& station : trace.stations) {
    shares.push_back(total > 0.0 ? station.area / total : 1.0 / static_cast<double>(trace.stations.size()));
  }
  return shares;
}

void note_ignition(SkinHistory& history, const trace::BottomTrace& trace, std::size_t station, double time,
                   double chemical_share) {
  const IgnitionCause cause = chemical_share > 0.5 ? IgnitionCause::arrhenius : IgnitionCause::trigger;
  if (trace.stations[station].observation) return;
  if (!history.ignition || time < history.ignition->time)
    history.ignition = Ignition{time, station, cause, chemical_share};
}

}  // namespace launchsafe::surface::detail
