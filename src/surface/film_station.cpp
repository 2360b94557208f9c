#include "launchsafe/surface/film_station.hpp"

namespace launchsafe::surface {
namespace detail {
namespace {

/// Shortest step as a share of an interval; a step that is still not exact enough is then taken as it is.
constexpr double shortest_share = 1e-7;
/// Largest ratio of pressures in a step. A thin film only follows the walls: its temperature says nothing of
/// how well the work is taken.
constexpr double largest_ratio = 1.1;

/// The length h (s) from `begin` (s) on, shortened until the pressure changes little enough in it.
double shortened(const IntervalPressure& pressure, double lowest, double length, double begin, double h) {
  const auto at = [&](double time) { return std::max(lowest, pressure.at(time / length)); };
  const double from = at(begin);
  while (h > shortest_share * length) {
    const double middle = at(begin + inner_stage * h), to = at(begin + h);
    const double most = std::max({from, middle, to}), least = std::min({from, middle, to});
    if (!(most > largest_ratio * least)) break;
    h *= 0.5;
  }
  return h;
}

}  // namespace

FilmStation::FilmStation(const SkinModel& model, const FilmGrid& grid, double tolerance,
                         double start_pressure, double lowest_pressure)
    : model_(&model),
      tolerance_(tolerance),
      grid_(&grid),
      lowest_pressure_(lowest_pressure),
      trigger_(trigger_of(model)),
      reacts_(model.kinetics.heat_of_reaction * model.kinetics.frequency > 0.0),
      column_(grid, model.surface.air, model.initial_temperature, model.initial_temperature),
      warmed_(grid.air_begin, 0.0),
      melted_(grid.air_begin, 0.0) {
  failed_ = !std::isfinite(start_pressure);
  column_.compress_to(std::max(start_pressure, lowest_pressure));
  start_.gas = column_.air_enthalpy();
  point_.temperature = model.initial_temperature;
}

void FilmStation::advance(const IntervalPressure& pressure, double length, double heating) {
  if (point_.ignited || failed_) return;
  failed_ = !std::isfinite(pressure.begin) || !std::isfinite(pressure.end) || !std::isfinite(pressure.mean) ||
            !std::isfinite(heating) || !std::isfinite(length);
  if (!(wanted_ > 0.0)) wanted_ = length;
  for (double at = 0.0; at < length && !point_.ignited && !failed_;) {
    const double left = length - at;
    const double h = shortened(pressure, lowest_pressure_, length, at,
                               left / std::ceil(left / std::min(wanted_, left) - 1e-9));
    kept_ = column_.state();
    kept_melted_ = melted_;
    const bool finite = try_step(pressure, length, at, h, heating);
    const bool shortest = h <= shortest_share * length;
    if (!finite && shortest) failed_ = true;
    const double factor = finite ? 0.9 / std::cbrt(std::max(error_, 1e-3)) : 0.1;
    wanted_ = std::max(h * std::clamp(factor, 0.1, 5.0), shortest_share * length);
    const bool accepted = finite && (error_ <= 1.0 || shortest);
    if (accepted && !point_.ignited) {
      at = left <= h * (1.0 + 1e-9) ? length : at + h;
      energy_.work += column_.heat().work;
      energy_.friction += column_.heat().friction;
      energy_.reaction += reaction_;
      wanted_ = std::min(wanted_, longest_step());
    } else {
      // Also before the step in which it ignites: what burns is no longer this column's account.
      column_.restore(kept_);
      melted_ = kept_melted_;
      point_.ignited = accepted && point_.ignited;
    }
  }
  close_account();
}

/// Half the reaction, conduction, half the reaction: of second order. False where a state is not finite.
bool FilmStation::try_step(const IntervalPressure& pressure, double length, double begin, double h,
                           double heating) {
  const auto at = [&](double share) {
    return std::max(lowest_pressure_, pressure.at(std::min(1.0, (begin + share * h) / length)));
  };
  reaction_ = error_ = 0.0;
  react(begin, 0.5 * h);
  if (point_.ignited) return true;
  const double surface_before = column_.charge_surface();
  for (std::size_t i = 0; i < warmed_.size(); ++i) warmed_[i] = -column_.temperature(i) / h;
  error_ = column_.step(h, {at(0.0), at(inner_stage), at(1.0)}, heating) / tolerance_;
  if (!std::isfinite(error_)) return false;
  for (std::size_t i = 0; i < warmed_.size(); ++i) warmed_[i] += column_.temperature(i) / h;
  melt();
  release_heat(surface_before, begin, h);
  if (!point_.ignited) react(begin + 0.5 * h, 0.5 * h);
  return true;
}

/// Arrhenius heat of all depths over h (s), without conduction.
void FilmStation::react(double time, double h) {
  constexpr double negligible = 1e-15, mild = 1e-3;
  if (!reacts_) return;
  for (std::size_t i = 0; i < warmed_.size(); ++i) {
    const double before = column_.temperature(i);
    const double rate = materials::arrhenius_heating(model_->kinetics, model_->specific_heat, before);
    if (rate * h < negligible * before && before < trigger_.temperature) continue;
    const double growth = h * rate * model_->kinetics.activation_temperature / (before * before);
    SkinPoint point{before + h * rate * (1.0 + 0.5 * growth)};
    if (!(growth < mild) || !(point.temperature < trigger_.temperature)) {
      point = surface::detail::advance(*model_, SkinEquation{}, SkinPoint{before}, h);
      point.chemical_share = surface::detail::chemical_share(*model_, trigger_.temperature, warmed_[i]);
    }
    column_.set_temperature(i, point.temperature);
    reaction_ += grid_->capacity[i] * (point.temperature - before);
    if (point.ignited) note(point, time + point.ignition_time);
  }
}

/// What a depth has beyond the melting temperature melts it before it gets warmer, and what it lacks freezes
/// it again: of first order in the step.
void FilmStation::melt() {
  if (!model_->surface.melts) return;
  const double most = model_->heat_of_melting / model_->specific_heat;
  for (std::size_t i = 0; i < melted_.size(); ++i) {
    const double before = column_.temperature(i);
    const double taken = std::clamp(before - model_->melting_temperature, -melted_[i], most - melted_[i]);
    if (taken == 0.0) continue;
    melted_[i] += taken;
    column_.set_temperature(i, before - taken);
    reaction_ -= grid_->capacity[i] * taken;
  }
}

/// Where conduction and friction carried a depth or the surface past the trigger.
void FilmStation::release_heat(double surface_before, double time, double h) {
  for (std::size_t i = 0; i < warmed_.size(); ++i) {
    SkinPoint point{column_.temperature(i)};
    if (!(point.temperature > trigger_.temperature)) continue;
    const double after = point.temperature;
    release(*model_, trigger_, point, after - warmed_[i] * h, warmed_[i], time, h);
    column_.set_temperature(i, point.temperature);
    reaction_ += grid_->capacity[i] * (point.temperature - after);
    if (point.ignited) note(point, point.ignition_time);
  }
  SkinPoint point{column_.charge_surface()};
  if (!trigger_.immediate || !(point.temperature > trigger_.temperature)) return;
  release(*model_, trigger_, point, surface_before, (point.temperature - surface_before) / h, time, h);
  if (point.ignited) note(point, point.ignition_time);
}

/// The first of those that ignite in a step counts.
void FilmStation::note(const SkinPoint& ignited, double time) {
  if (point_.ignited && point_.ignition_time <= time) return;
  point_ = ignited;
  point_.ignition_time = time;
}

/// s; while a runaway begins, conduction must take turns with it often enough.
double FilmStation::longest_step() const {
  constexpr double growth = 0.2;
  if (!reacts_) return std::numeric_limits<double>::infinity();
  const double hottest = hottest_depth();
  const double rate = materials::arrhenius_heating(model_->kinetics, model_->specific_heat, hottest);
  return growth * hottest * hottest / (rate * model_->kinetics.activation_temperature);
}

void FilmStation::close_account() {
  if (failed_) return;
  energy_.charge = column_.charge_heat() - start_.charge;
  energy_.base = column_.base_heat() - start_.base;
  energy_.gas = column_.air_enthalpy() - start_.gas;
}

double FilmStation::surface() const {
  if (failed_) return math::not_a_number;
  return point_.ignited ? std::max(point_.temperature, model_->kinetics.burnt_temperature)
                        : column_.charge_surface();
}

double FilmStation::hottest_depth() const {
  double hottest = 0.0;
  if (point_.ignited || failed_) return hottest;
  for (std::size_t i = 0; i < warmed_.size(); ++i) hottest = std::max(hottest, column_.temperature(i));
  return hottest;
}

double FilmStation::mean_air() const { return failed_ ? math::not_a_number : column_.mean_air(); }

}  // namespace detail

namespace {

/// Area shares of the stations, summing to 1; equal shares where no station has an area.
std::vector<double> area_shares(const trace::BottomTrace& trace) {
  double total = 0.0;
  for (const trace::Station& station : trace.stations) total += station.area;
  std::vector<double> shares;
  for (const trace::Station& station : trace.stations)
    shares.push_back(total > 0.0 ? station.area / total : 1.0 / static_cast<double>(trace.stations.size()));
  return shares;
}

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
  const auto grid = detail::film_grid(model, gap, trace.time.back() - trace.time.front(), numerics);
  const std::vector<double> shares = area_shares(trace);
  std::vector<detail::FilmStation> stations(
      trace.stations.size(), detail::FilmStation(model, grid, numerics.tolerance, intervals.pressure_at(0),
                                                 model.surface.air.initial_pressure));
  record(stations, shares, result.skin);
  // Before anything conducts the surface is as warm as the charge, whatever air it then meets.
  std::ranges::fill(result.skin.temperature, model.initial_temperature);
  for (std::size_t interval = 0; interval < intervals.count(); ++interval) {
    const detail::IntervalPressure pressure = intervals.pressure(interval);
    for (std::size_t s = 0; s < stations.size(); ++s) {
      const bool was_ignited = stations[s].ignited();
      stations[s].advance(pressure, intervals.length(interval), intervals.friction_heating(interval, s));
      if (stations[s].ignited() && !was_ignited && !trace.stations[s].observation)
        result.skin.note_ignition(s, trace.time[interval] + stations[s].ignition_time(),
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
