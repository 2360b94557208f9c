#include "launchsafe/surface/gap_columns.hpp"

#include <numeric>

namespace launchsafe::surface {
namespace {

/// Of the pressure at rest: air stretched further counts as it is there.
constexpr double lowest_share = 1e-6;
/// How far what conduction did in an interval may lead away from the exchange of a film of even heating, and
/// the least share of the temperature over that of the walls that tells one.
constexpr double largest_ratio = 10.0, least_excess = 2e-3;
/// How well a column's air fills its opening, by iterations of second order.
constexpr double same_volume = 1e-13;
/// The same of a single column, where air flows between them: it is left to flow in the next interval.
constexpr double same_place = 1e-9;
constexpr int most_iterations = 20;

}  // namespace

/// K, of the air over the walls that take its heat.
double GapColumns::temperature_of_walls(const detail::FilmColumn& film) const {
  const double charge = film.charge_surface();
  return model_.base_conductivity > 0.0 ? 0.5 * (charge + film.base_surface()) : charge;
}

/// m/s, of a film of even heating.
double GapColumns::usual_exchange(const detail::FilmColumn& film) const {
  const double mean = 0.5 * (temperature_of_walls(film) + film.mean_air());
  return (model_.base_conductivity > 0.0 ? 12.0 : 3.0) * materials::air_conductivity(mean) /
         film.air_heat_capacity();
}

/// Of columns that are too full as much leaves as has no place, and is divided over the others by the place
/// that they have: where their heat capacity is constant, all are full then.
void GapColumns::move_air(const std::vector<double>& openings, const std::vector<double>& areas) {
  double leaving = 0.0, enthalpy = 0.0, free = 0.0;
  std::vector<double> more(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const detail::FilmColumn& film = columns_[i].column();
    more[i] = openings[i] - film.air_volume() - film.covolume();
    if (more[i] > 0.0) free += areas[i] * more[i];
    if (!(more[i] < 0.0)) continue;
    more[i] *= film.air_share() / (openings[i] - more[i]);
    leaving -= areas[i] * more[i];
    enthalpy -= areas[i] * more[i] * film.specific_enthalpy();
  }
  if (!(leaving > 0.0 && free > 0.0)) return;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    columns_[i].take_air(more[i] > 0.0 ? leaving * more[i] / free : more[i], enthalpy / leaving);
}

FilmNumerics GapColumns::numerics_of(const scene::Surface& surface) {
  const auto depth = static_cast<std::size_t>(surface.depth_cells);
  return {.charge_cells = depth,
          .gas_cells = static_cast<std::size_t>(surface.air_cells),
          .base_cells = depth * 3 / 5,
          .tolerance = 1e-3 / surface.turns};
}

GapColumns::GapColumns(const SkinModel& model, std::size_t columns, double gap, double duration,
                       const FilmNumerics& numerics)
    : model_(model), grid_(detail::film_grid(model, gap, duration, numerics)), intervals_(columns) {
  const double rest = model.surface.air.initial_pressure;
  columns_.assign(columns, detail::FilmStation(model_, grid_, numerics.tolerance, rest, lowest_share * rest));
}

void GapColumns::advance(std::size_t column, double length, double begin, double end, double mean,
                         double heating) {
  columns_[column].compress_to(begin);
  columns_[column].advance({begin, end, mean}, length, heating);
  intervals_[column].length = length;
}

/// m/s, of air which an interval has left in the state `conducted`, before an isentropic change gives it the
/// volume of an opening (m): what conduction did to its volume in the interval, over what its temperature was
/// above that of the walls.
double GapColumns::exchange_of(const Interval& interval, const EnclosedAir& conducted, double opening,
                               double usual) {
  const auto excess_of = [](const EnclosedAir& air) { return 1.0 - air.volume_at_walls / air.volume; };
  const double excess = 0.5 * (excess_of(interval.air) + excess_of(conducted));
  if (!(interval.length > 0.0) || !(std::abs(excess) > least_excess)) return usual;
  const double shrunk = -std::log(conducted.volume / interval.air.volume) -
                        std::log(conducted.pressure / interval.air.pressure) / interval.air.exponent;
  return std::clamp(shrunk / excess * 0.5 * (interval.opening + opening) / interval.length,
                    usual / largest_ratio, usual * largest_ratio);
}

EnclosedAir GapColumns::fit(std::size_t column, double opening) {
  detail::FilmStation& station = columns_[column];
  Interval& interval = intervals_[column];
  const detail::FilmColumn& film = station.column();
  const auto at_walls = [&] { return film.air_volume() * temperature_of_walls(film) / film.mean_air(); };
  const EnclosedAir conducted{
      .pressure = film.pressure(), .volume = film.air_volume(), .volume_at_walls = at_walls()};
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
  now.volume_at_walls = at_walls();
  now.exchange = exchange_of(interval, conducted, opening, usual_exchange(film));
  interval = {0.0, opening, now};
  return now;
}

EnclosedAir GapColumns::fit_together(double pressure, const std::vector<double>& openings,
                                     const std::vector<double>& areas) {
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const auto mean = [&](auto of_column) {
    double sum = 0.0;
    for (std::size_t i = 0; i < columns_.size(); ++i) sum += areas[i] * of_column(i, columns_[i].column());
    return sum / area;
  };
  const auto volume = [](std::size_t, const detail::FilmColumn& film) { return film.air_volume(); };
  // What has ignited is compressed without conduction.
  const auto at_walls = [&](std::size_t i, const detail::FilmColumn& film) {
    return film.air_volume() * (columns_[i].ignited() ? 1.0 : temperature_of_walls(film) / film.mean_air());
  };
  const double opening = mean([&](std::size_t i, const auto&) { return openings[i]; });
  for (detail::FilmStation& column : columns_) column.compress_to(pressure);
  const EnclosedAir conducted{
      .pressure = pressure, .volume = mean(volume), .volume_at_walls = mean(at_walls)};
  EnclosedAir now;
  now.volume = opening - mean([](std::size_t, const auto& film) { return film.covolume(); });
  for (int count = 0; count < most_iterations; ++count) {
    const double filled = mean(volume), misplaced = mean([&](std::size_t i, const auto&film) {
                                          return std::abs(openings[i] - film.air_volume() - film.covolume());
                                        });
    now.exponent =
        filled / mean([](std::size_t, const auto& film) { return film.air_volume() / film.exponent(); });
    if (std::abs(filled / now.volume - 1.0) < same_volume && misplaced < same_place * opening) break;
    pressure *= std::pow(filled / now.volume, now.exponent);
    for (detail::FilmStation& column : columns_) column.compress_to(pressure);
    move_air(openings, areas);
  }
  now.pressure = pressure;
  now.volume_at_walls = mean(at_walls);
  const double usual =
      opening / now.volume * mean([&](std::size_t i, const auto& film) {
        return columns_[i].ignited() ? 0.0 : film.air_volume() * usual_exchange(film) / openings[i];
      });
  shared_.length = intervals_.front().length;
  now.exchange = exchange_of(shared_, conducted, opening, usual);
  shared_ = {0.0, opening, now};
  return now;
}

}  // namespace launchsafe::surface
