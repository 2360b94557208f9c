#include "launchsafe/scene/stations.hpp"

#include "launchsafe/scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::scene {
namespace {

/// Radii between which bodies of the charge reach its bottom.
Extent bottom_of(const Scene& scene) {
  const Extent charge = charge_extent(scene);
  Extent bottom{charge.x_end, charge.x_end, std::numeric_limits<double>::infinity(), 0.0};
  for (const Body& body : scene.bodies) {
    if (!is_charge(scene, body) || body.x_end < charge.x_end) continue;
    bottom.r_begin = std::min(bottom.r_begin, body.r_begin);
    bottom.r_end = std::max(bottom.r_end, body.r_end);
  }
  return bottom;
}

/// Length of the last interval between lines before a place.
double cell_before(const std::vector<double>& lines, double place) {
  const double slack = 1e-9 * (lines.back() - lines.front());
  const auto behind = std::lower_bound(lines.begin() + 1, lines.end() - 1, place - slack);
  return *behind - *(behind - 1);
}

}  // namespace

std::vector<StationExtent> stations_of(const Scene& scene) {
  std::vector<StationExtent> stations;
  if (!has_charge(scene)) return stations;
  const Extent bottom = bottom_of(scene);
  const double width = bottom.r_end - bottom.r_begin;
  const int count = std::max(1, static_cast<int>(std::lround(width / scene.surface.station_width)));
  const auto edge = [&](int k) { return bottom.r_end - width * k / count; };
  for (int k = 0; k < count; ++k)
    stations.push_back({fmt::format("S{}", k + 1), bottom.x_end - scene.surface.station_depth, bottom.x_end,
                        k + 1 == count ? bottom.r_begin : edge(k + 1), edge(k)});
  return stations;
}

StationCells cells_in_stations(const Scene& scene) {
  const std::vector<StationExtent> stations = stations_of(scene);
  if (stations.empty()) return {};
  const GridLines lines = lines_at_rest(scene);
  const StationExtent& corner = stations.front();
  const double width = corner.r_end - corner.r_begin;
  double longest = 0.0;
  for (std::size_t i = 0; i + 1 < lines.r.size() && lines.r[i] < corner.r_end; ++i)
    longest = std::max(longest, lines.r[i + 1] - lines.r[i]);
  return {(corner.x_end - corner.x_begin) / cell_before(lines.x, corner.x_end),
          width / cell_before(lines.r, corner.r_end), width / longest};
}

}  // namespace launchsafe::scene
