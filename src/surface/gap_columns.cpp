#include "launchsafe/surface/gap_columns.hpp"

#include "film_station.hpp"
#include "launchsafe/materials/air_conductivity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace launchsafe::surface {

namespace {

/// Of the pressure at rest: air stretched further counts as it is there.
constexpr double lowest_share = 1e-6;
/// How far what an interval lost may lead away from the exchange of a film of even heating, and the least
/// difference of temperatures (K) that tells one.
constexpr double largest_ratio = 10.0, least_excess = 0.5;

/// A column at the begin of its interval, and since then.
struct Interval {
  double length = 0;   ///< s
  double opening = 0;  ///< m, at the begin
  double excess = 0;   ///< K, of the air over the walls, at the begin
  double heat = 0;     ///< J/m2, of charge and base beyond friction and reaction, at the begin
};

double heat_from_air(const FilmEnergy& energy) {
  return energy.charge + energy.base - energy.friction - energy.reaction;
}

}  // namespace

struct GapColumns::Parts {
  SkinModel model;
  detail::FilmGrid grid;
  std::vector<detail::FilmStation> columns;
  std::vector<Interval> intervals;

  /// K, of the air over the walls that take its heat.
  double walls(const detail::FilmColumn& film) const {
    const double charge = film.charge_surface();
    return model.base_conductivity > 0.0 ? 0.5 * (charge + film.base_surface()) : charge;
  }
};

GapColumns::GapColumns(const SkinModel& model, std::size_t columns, double gap, double duration,
                       const FilmNumerics& numerics)
    : parts_(
          std::make_unique<Parts>(Parts{model, detail::film_grid(model, gap, duration, numerics), {}, {}})) {
  const double rest = model.surface.air.initial_pressure;
  parts_->columns.assign(
      columns, detail::FilmStation(parts_->model, parts_->grid, numerics, rest, lowest_share * rest));
  parts_->intervals.resize(columns);
}

GapColumns::GapColumns(GapColumns&&) noexcept = default;
GapColumns::~GapColumns() = default;

void GapColumns::advance(std::size_t column, double length, double begin, double end, double mean,
                         double heating) {
  parts_->columns[column].compress_to(begin);
  parts_->columns[column].advance({begin, end, mean}, length, heating);
  parts_->intervals[column].length = length;
}

EnclosedAir GapColumns::fit(std::size_t column, double opening) {
  detail::FilmStation& station = parts_->columns[column];
  Interval& interval = parts_->intervals[column];
  const materials::AirParameters& air = parts_->model.surface.air;
  const detail::FilmColumn& film = station.column();
  const double excess_before = film.mean_air() - parts_->walls(film);
  station.compress_to(film.pressure() * std::pow(film.air_volume() / (opening - covolume()), air.heat_ratio));
  EnclosedAir now;
  now.pressure = film.pressure();
  now.volume = film.air_volume();
  now.exponent = air.heat_ratio;
  if (station.ignited()) return now;
  const double walls = parts_->walls(film), mean = film.mean_air(), capacity = film.air_heat_capacity();
  const double usual = (parts_->model.base_conductivity > 0.0 ? 12.0 : 3.0) *
                       materials::air_conductivity(0.5 * (walls + mean)) / capacity;
  now.volume_at_walls = now.volume * walls / mean;
  now.exchange = usual;
  const double heat = heat_from_air(station.energy()), excess = 0.5 * (interval.excess + excess_before);
  if (interval.length > 0.0 && std::abs(excess) > least_excess)
    now.exchange = std::clamp(
        (heat - interval.heat) / (capacity * excess) * 0.5 * (interval.opening + opening) / interval.length,
        usual / largest_ratio, usual * largest_ratio);
  interval = {0.0, opening, mean - walls, heat};
  return now;
}

double GapColumns::hottest(std::size_t column) const {
  const detail::FilmStation& station = parts_->columns[column];
  return std::max(station.surface(), station.hottest_depth());
}

double GapColumns::mean_air(std::size_t column) const { return parts_->columns[column].mean_air(); }
bool GapColumns::failed(std::size_t column) const { return parts_->columns[column].failed(); }
bool GapColumns::ignited(std::size_t column) const { return parts_->columns[column].ignited(); }
double GapColumns::ignition_time(std::size_t column) const { return parts_->columns[column].ignition_time(); }
double GapColumns::chemical_share(std::size_t column) const {
  return parts_->columns[column].chemical_share();
}
const FilmEnergy& GapColumns::energy(std::size_t column) const { return parts_->columns[column].energy(); }
double GapColumns::covolume() const { return 0.0; }

}  // namespace launchsafe::surface
