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
/// How far what conduction did in an interval may lead away from the exchange of a film of even heating, and
/// the least share of the temperature over that of the walls that tells one.
constexpr double largest_ratio = 10.0, least_excess = 2e-3;
/// How well a column's air fills its opening, by iterations of second order.
constexpr double same_volume = 1e-13;
constexpr int most_iterations = 20;

/// A column at the begin of its interval, and since then.
struct Interval {
  double length = 0;     ///< s
  double opening = 0;    ///< m, at the begin
  double excess = 0;     ///< of the air's temperature over that of the walls, as a share of it, at the begin
  EnclosedAir air = {};  ///< at the begin
};

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

FilmNumerics GapColumns::numerics_of(const scene::Surface& surface) {
  const auto depth = static_cast<std::size_t>(surface.depth_cells);
  return {.charge_cells = depth,
          .gas_cells = static_cast<std::size_t>(surface.air_cells),
          .base_cells = depth * 3 / 5,
          .tolerance = 1e-3 / surface.turns};
}

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
  const detail::FilmColumn& film = station.column();
  const double excess = 0.5 * (interval.excess + 1.0 - parts_->walls(film) / film.mean_air());
  // What conduction did to the volume, beside the isentropic change.
  const double conducted = std::log(film.air_volume() / interval.air.volume) +
                           std::log(film.pressure() / interval.air.pressure) / interval.air.exponent;
  EnclosedAir now;
  now.volume = opening - film.covolume();
  for (int count = 0; count < most_iterations; ++count) {
    const double share = film.air_volume() / now.volume;
    now.exponent = film.exponent();
    if (std::abs(share - 1.0) < same_volume) break;
    station.compress_to(film.pressure() * std::pow(share, now.exponent));
  }
  now.pressure = film.pressure();
  if (station.ignited()) return now;
  const double walls = parts_->walls(film), mean = film.mean_air();
  const double usual = (parts_->model.base_conductivity > 0.0 ? 12.0 : 3.0) *
                       materials::air_conductivity(0.5 * (walls + mean)) / film.air_heat_capacity();
  now.volume_at_walls = now.volume * walls / mean;
  now.exchange = usual;
  if (interval.length > 0.0 && std::abs(excess) > least_excess)
    now.exchange = std::clamp(-conducted / excess * 0.5 * (interval.opening + opening) / interval.length,
                              usual / largest_ratio, usual * largest_ratio);
  interval = {0.0, opening, 1.0 - walls / mean, now};
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
double GapColumns::covolume() const { return parts_->columns.front().column().covolume(); }

}  // namespace launchsafe::surface
