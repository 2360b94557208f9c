#include "launchsafe/scene/plan.hpp"

#include <fmt/format.h>

#include <cassert>

namespace launchsafe::scene {
namespace {

/// How many cells there are between two places, not rounded. Away from a refined line cells are
/// cell_size g^n long, n = 0, 1, ..; n of them reach d = cell_size (g^n - 1)/(g - 1), up to where they are as
/// long as the largest.
class CellDensity {
 public:
  CellDensity(double smallest, double largest, double growth, std::vector<double> refined)
      : smallest_(smallest),
        largest_(std::max(smallest, largest)),
        growth_(largest_ > smallest_ ? growth : 1.0),
        log_growth_(std::log(growth_)),
        reach_(growth_ > 1.0 ? (largest_ - smallest_) / (growth_ - 1.0) : 0.0),
        refined_(std::move(refined)) {
    std::ranges::sort(refined_);
  }

  bool even() const { return !(growth_ > 1.0) || refined_.empty(); }

  double cells(double from, double to) const {
    if (even()) return (to - from) / smallest_;
    double total = 0.0, begin = from;
    // Between two refined lines the nearest changes halfway.
    for (std::size_t i = 0; i < refined_.size(); ++i) {
      const double end =
          i + 1 < refined_.size() ? std::clamp(0.5 * (refined_[i] + refined_[i + 1]), begin, to) : to;
      total += cells_beside(end - refined_[i]) - cells_beside(begin - refined_[i]);
      begin = end;
    }
    return total;
  }

 private:
  /// From a refined line to a place beside it; odd in the distance.
  double cells_beside(double distance) const {
    const double d = std::abs(distance);
    const double growing = std::log1p((growth_ - 1.0) * std::min(d, reach_) / smallest_) / log_growth_;
    return std::copysign(growing + std::max(d - reach_, 0.0) / largest_, distance);
  }

  double smallest_, largest_, growth_;
  double log_growth_;
  double reach_;  ///< m, from a refined line to where cells are as long as the largest
  std::vector<double> refined_;
};

/// The place between two lines up to which there are so many cells.
double position_of(const CellDensity& density, double from, double to, double cells) {
  double low = from, high = to;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (density.cells(from, middle) < cells ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> lines_through(std::vector<double> edges, double tolerance, const CellDensity& density) {
  edges = distinct(std::move(edges), tolerance);
  std::vector<double> lines{edges.front()};
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const double from = edges[e], to = edges[e + 1], all = density.cells(from, to);
    const int count = std::max(1, static_cast<int>(std::ceil(all - 1e-9)));
    for (int i = 1; i < count; ++i)
      lines.push_back(density.even() ? from + (to - from) * i / count
                                     : position_of(density, from, to, all * i / count));
    lines.push_back(to);
  }
  return lines;
}

/// Lines of the grid from one place to another, each interval cut into parts.
std::vector<double> cut(const std::vector<double>& lines, double from, double to, int parts,
                        double tolerance) {
  std::vector<double> edges;
  double end = from;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i] < from - tolerance || lines[i + 1] > to + tolerance) continue;
    for (int k = 0; k < parts; ++k) edges.push_back(lines[i] + (lines[i + 1] - lines[i]) * k / parts);
    end = lines[i + 1];
  }
  if (!edges.empty()) edges.push_back(end);
  return edges;
}

std::vector<double> even(double from, double to, int count) {
  std::vector<double> edges;
  for (int i = 0; i <= count; ++i) edges.push_back(from + (to - from) * i / count);
  edges.back() = to;
  return edges;
}

/// Whole cells of the even grid from the line it is anchored at to the shell's two ends.
std::pair<int, int> cells_beside_anchor(const Mesh& mesh, const Extent& shell) {
  const auto cells = [&mesh](double length) { return length > 0.0 ? parts_of(length, mesh.dx) : 0; };
  return {cells(mesh.x_anchor - shell.x_begin), cells(shell.x_end - mesh.x_anchor)};
}

bool is_lattice(const Scene& scene) { return scene.numerics.formulation == Formulation::total_lagrangian; }

/// Cells of a part of the scene: a lattice has lines through its edges.
template <class Part>
CellRange cells_within(const Scene& scene, const Part& part) {
  const double length = part.x_end - part.x_begin, width = part.r_end - part.r_begin;
  if (!is_lattice(scene)) {
    const Mesh mesh = fit_mesh(scene);
    return {parts_of(length, mesh.dx), parts_of(width, mesh.dr), mesh.dx, mesh.dr};
  }
  const GridLines lines = grid_lines(scene);
  const double tolerance = length_tolerance(scene);
  const auto x = cut(lines.x, part.x_begin, part.x_end, 1, tolerance),
             r = cut(lines.r, part.r_begin, part.r_end, 1, tolerance);
  const auto shortest = [](const std::vector<double>& edges, double all) {
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) all = std::min(all, edges[i + 1] - edges[i]);
    return all;
  };
  return {static_cast<int>(x.size()) - 1, static_cast<int>(r.size()) - 1, shortest(x, length),
          shortest(r, width)};
}

/// The bodies of the charge that reach its bottom.
Extent bottom_of(const Scene& scene) {
  return extent_where(scene, [&, end = charge_extent(scene).x_end](const Body& body) {
    return is_charge(scene, body) && body.x_end >= end;
  });
}

/// Length of the last interval between lines before a place.
double cell_before(const std::vector<double>& lines, double place) {
  const double slack = 1e-9 * (lines.back() - lines.front());
  const auto behind = std::lower_bound(lines.begin() + 1, lines.end() - 1, place - slack);
  return *behind - *(behind - 1);
}

}  // namespace

std::vector<double> distinct(std::vector<double> places, double tolerance) {
  std::ranges::sort(places);
  const auto rest = std::ranges::unique(places, [&](double a, double b) { return b - a <= tolerance; });
  places.erase(rest.begin(), rest.end());
  return places;
}

GridLines grid_lines(const Scene& scene) {
  std::vector<double> x, r, refined_x, refined_r;
  for (const Body& body : scene.bodies) {
    x.insert(x.end(), {body.x_begin, body.x_end});
    r.insert(r.end(), {body.r_begin, body.r_end});
    if (!is_charge(scene, body)) continue;
    refined_r.push_back(body.r_end);
    if (body.r_begin > 0.0) refined_r.push_back(body.r_begin);
  }
  if (has_charge(scene)) refined_x = {charge_extent(scene).x_end};
  const double tolerance = length_tolerance(scene), smallest = scene.numerics.cell_size;
  const double largest_x = scene.numerics.largest_cell;
  const std::vector<StationExtent> stations = stations_of(scene);
  const double largest_r =
      stations.empty() ? largest_x : std::min(largest_x, stations.front().r_end - stations.front().r_begin);
  return {lines_through(std::move(x), tolerance,
                        CellDensity(smallest, largest_x, scene.numerics.growth_x, std::move(refined_x))),
          lines_through(std::move(r), tolerance,
                        CellDensity(smallest, largest_r, scene.numerics.growth_r, std::move(refined_r)))};
}

GridLines lines_at_rest(const Scene& scene) {
  if (is_lattice(scene)) return grid_lines(scene);
  const Mesh mesh = fit_mesh(scene);
  const auto [before, after] = cells_beside_anchor(mesh, extent_of(scene));
  return {even(mesh.x_anchor - before * mesh.dx, mesh.x_anchor + after * mesh.dx, before + after),
          even(0.0, mesh.radius, parts_of(mesh.radius, mesh.dr))};
}

GridLines particle_edges(const Scene& scene, const Body& body) {
  if (!is_lattice(scene)) {
    const ParticleCount count = particles_of(scene, body);
    return {even(body.x_begin, body.x_end, count.nx), even(body.r_begin, body.r_end, count.nr)};
  }
  const int per_cell = scene.numerics.particles_per_cell;
  const GridLines lines = grid_lines(scene);
  const double tolerance = length_tolerance(scene);
  return {cut(lines.x, body.x_begin, body.x_end, per_cell, tolerance),
          cut(lines.r, body.r_begin, body.r_end, per_cell, tolerance)};
}

CellRange cells_of(const Scene& scene) {
  if (is_lattice(scene)) return cells_within(scene, extent_of(scene));
  const GridLines lines = lines_at_rest(scene);
  const Mesh mesh = fit_mesh(scene);
  return {static_cast<int>(lines.x.size()) - 1, static_cast<int>(lines.r.size()) - 1, mesh.dx, mesh.dr};
}

CellRange cells_of_charge(const Scene& scene) {
  return has_charge(scene) ? cells_within(scene, charge_extent(scene)) : cells_of(scene);
}

CellRange cells_of(const Scene& scene, const Body& body) { return cells_within(scene, body); }

std::size_t nearest_line(const std::vector<double>& lines, double place) {
  auto nearest = std::ranges::lower_bound(lines, place);
  if (nearest == lines.end()) --nearest;
  if (nearest != lines.begin() && std::abs(*(nearest - 1) - place) < std::abs(*nearest - place)) --nearest;
  return static_cast<std::size_t>(nearest - lines.begin());
}

std::int64_t counted(double count) {
  return count < static_cast<double>(most_counted) ? static_cast<std::int64_t>(count) : most_counted;
}

int parts_of(double length, double part) {
  const double parts = std::ceil(length / part - 1e-9);
  assert(parts < std::numeric_limits<int>::max());
  return std::max(1, static_cast<int>(parts));
}

Mesh fit_mesh(const Scene& scene) {
  const Extent all = extent_of(scene);
  const Extent fitted = has_charge(scene) ? charge_extent(scene) : all;
  const double length = fitted.x_end - fitted.x_begin;
  Mesh mesh;
  mesh.dx = length / parts_of(length, scene.numerics.cell_size);
  mesh.dr = all.r_end / parts_of(all.r_end, scene.numerics.cell_size);
  mesh.x_anchor = fitted.x_end;
  mesh.radius = all.r_end;
  return mesh;
}

std::string charge_edges_off_grid(const Scene& scene) {
  if (is_lattice(scene)) return {};
  const Mesh mesh = fit_mesh(scene);
  std::vector<std::string> edges;
  for (const Body& body : scene.bodies)
    for (const double r : {body.r_begin, body.r_end})
      if (const double cells = r / mesh.dr;
          is_charge(scene, body) && !(std::abs(cells - std::round(cells)) < 1e-6))
        edges.push_back(fmt::format("r = {:.6g} cm at {:.2f} cells", 100.0 * r, cells));
  return fmt::format("{}", fmt::join(edges, ", "));
}

ParticleCount particles_of(const Scene& scene, const Body& body) {
  const int per_cell = scene.numerics.particles_per_cell;
  if (is_lattice(scene)) {
    const CellRange cells = cells_of(scene, body);
    return {cells.nx * per_cell, cells.nr * per_cell};
  }
  const Mesh mesh = fit_mesh(scene);
  return {parts_of((body.x_end - body.x_begin) * per_cell, mesh.dx),
          parts_of((body.r_end - body.r_begin) * per_cell, mesh.dr)};
}

std::int64_t particle_count(const Scene& scene) {
  std::int64_t count = 0;
  for (const Body& body : scene.bodies) count += particles_of(scene, body).total();
  return count;
}

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
