// Stations: the parts of the charge's bottom over which pressure and strain are averaged.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

/// A box at the charge's bottom, m.
struct StationExtent {
  std::string name;  ///< "S1", "S2", ... from the largest radius inwards
  double x_begin = 0, x_end = 0, r_begin = 0, r_end = 0;
};

/// Stations that tile the charge's bottom: of equal width, the bottom's over the nearest whole number to
/// `surface.station_width` (at least one), and as deep as `surface.station_depth`. Of the published shell
/// they are 5 mm wide and have the published points in their middles. None without a charge.
std::vector<StationExtent> stations_of(const Scene& scene);

/// How many cells a station is deep and wide. In the corner of bottom and outer edge, where stresses are
/// singular and averages need them, as many as there would be of the cell there; along r also in the station
/// with the longest cell.
struct StationCells {
  double corner_x = 0, corner_r = 0, fewest_r = 0;
};
StationCells cells_in_stations(const Scene& scene);

}  // namespace launchsafe::scene
