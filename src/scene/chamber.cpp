// Which surfaces of the shell the chamber pressure acts on.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/quantity.hpp"

#include <tuple>

namespace launchsafe::scene {
namespace {

struct Cell {
  int column = 0, row = 0;
};

/// The half plane cut along all edges of bodies into cells that are of one body or open. The first column
/// lies before the shell and the last one behind it; the last row touches the barrel.
struct CutPlane {
  explicit CutPlane(const Scene& scene) {
    r = {0.0};
    for (const Body& each : scene.bodies) {
      x.insert(x.end(), {each.x_begin, each.x_end});
      r.insert(r.end(), {each.r_begin, each.r_end});
    }
    x = distinct(std::move(x), length_tolerance(scene));
    r = distinct(std::move(r), length_tolerance(scene));
    columns = static_cast<int>(x.size()) + 1;
    rows = static_cast<int>(r.size()) - 1;
    bodies.resize(static_cast<std::size_t>(columns * rows), -1);
    for (int i = 1; i + 1 < columns; ++i)
      for (int j = 0; j < rows; ++j) body({i, j}) = body_around(scene, i, j);
  }

  int body_around(const Scene& scene, int column, int row) const {
    const double x_middle = 0.5 * (x_of(column) + x_of(column + 1));
    const double r_middle = 0.5 * (r_of(row) + r_of(row + 1));
    const auto found = std::ranges::find_if(scene.bodies, [&](const Body& each) {
      return x_middle > each.x_begin && x_middle < each.x_end && r_middle > each.r_begin &&
             r_middle < each.r_end;
    });
    return found == scene.bodies.end() ? -1 : static_cast<int>(found - scene.bodies.begin());
  }

  bool contains(const Cell& cell) const {
    return cell.column >= 0 && cell.column < columns && cell.row >= 0 && cell.row < rows;
  }
  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.column * rows + cell.row);
  }
  int& body(const Cell& cell) { return bodies[index(cell)]; }
  int body(const Cell& cell) const { return bodies[index(cell)]; }
  double x_of(int column) const { return x[static_cast<std::size_t>(column) - 1]; }  ///< where it begins, m
  double r_of(int row) const { return r[static_cast<std::size_t>(row)]; }

  std::vector<double> x, r;
  int columns = 0, rows = 0;
  std::vector<int> bodies;  ///< of every cell; -1 where it is open
};

/// Cells beside one, each with the side that its body turns to it.
std::array<std::pair<Cell, BodySide>, 4> beside(const Cell& cell) {
  return {{{{cell.column - 1, cell.row}, BodySide::x_end},
           {{cell.column + 1, cell.row}, BodySide::x_begin},
           {{cell.column, cell.row - 1}, BodySide::r_end},
           {{cell.column, cell.row + 1}, BodySide::r_begin}}};
}

/// All open cells that gas reaches from some.
std::vector<Cell> filled_from(const CutPlane& plane, std::vector<Cell> cells) {
  std::vector<bool> known(plane.bodies.size());
  for (const Cell& cell : cells) known[plane.index(cell)] = true;
  for (std::size_t next = 0; next < cells.size(); ++next)
    for (const auto& each : beside(cells[next])) {
      const Cell& cell = each.first;
      if (!plane.contains(cell) || plane.body(cell) >= 0 || known[plane.index(cell)]) continue;
      known[plane.index(cell)] = true;
      cells.push_back(cell);
    }
  return cells;
}

std::vector<ChamberFace> faces_at(const CutPlane& plane, const std::vector<Cell>& gas) {
  std::vector<ChamberFace> all, joined;
  for (const Cell& cell : gas)
    for (const auto& [neighbour, side] : beside(cell)) {
      if (!plane.contains(neighbour) || plane.body(neighbour) < 0) continue;
      ChamberFace face{static_cast<std::size_t>(plane.body(neighbour)), side, 0.0, 0.0};
      face.begin = face.across_x() ? plane.r_of(cell.row) : plane.x_of(cell.column);
      face.end = face.across_x() ? plane.r_of(cell.row + 1) : plane.x_of(cell.column + 1);
      all.push_back(face);
    }
  std::ranges::sort(all, {},
                    [](const ChamberFace& face) { return std::tuple(face.body, face.side, face.begin); });
  for (const ChamberFace& face : all) {
    const bool goes_on = !joined.empty() && joined.back().body == face.body &&
                         joined.back().side == face.side && joined.back().end == face.begin;
    if (goes_on)
      joined.back().end = face.end;
    else
      joined.push_back(face);
  }
  return joined;
}

/// The first and the last column of the foremost annulus of full radius, or of the one around a stated place
/// (m); nothing where the shell is narrower there.
std::optional<std::pair<int, int>> ring_of_band(const CutPlane& plane, const std::optional<double>& stated,
                                                double tolerance) {
  const auto is_full = [&](int column) { return plane.body({column, plane.rows - 1}) >= 0; };
  for (int first = 1; first + 1 < plane.columns; ++first) {
    if (!is_full(first)) continue;
    int last = first;
    while (is_full(last + 1)) ++last;
    if (!stated || (*stated >= plane.x_of(first) - tolerance && *stated <= plane.x_of(last + 1) + tolerance))
      return std::pair(first, last);
    first = last;
  }
  return std::nullopt;
}

}  // namespace

Chamber chamber_of(const Scene& scene) {
  if (scene.bodies.empty()) return {};
  const CutPlane plane(scene);
  const int barrel = plane.rows - 1;
  std::vector<Cell> behind;
  for (int row = 0; row < plane.rows; ++row) behind.push_back({plane.columns - 1, row});
  Chamber chamber{faces_at(plane, behind), 0.0, false};
  const auto ring = ring_of_band(plane, scene.load.obturation, length_tolerance(scene));
  if (!ring) return chamber;
  const auto [first, last] = *ring;
  chamber.band = plane.x_of(last + 1);
  std::vector<Cell> gas = behind;
  for (int column = last + 1; column + 1 < plane.columns; ++column)
    if (plane.body({column, barrel}) < 0) gas.push_back({column, barrel});
  gas = filled_from(plane, std::move(gas));
  std::vector<ChamberFace> faces = faces_at(plane, gas);
  const bool passes = std::ranges::any_of(gas, [&, begin = first](const Cell& cell) {
    return cell.column == 0 || (cell.row == barrel && cell.column < begin);
  });
  const bool burns = std::ranges::any_of(
      faces, [&](const ChamberFace& face) { return is_charge(scene, scene.bodies[face.body]); });
  const bool is_even = scene.numerics.formulation == Formulation::updated_lagrangian;
  chamber.sealed = !passes && !burns && (!is_even || faces == chamber.faces);
  if (chamber.sealed) chamber.faces = std::move(faces);
  return chamber;
}

std::string chamber_text(const Scene& scene, double pressure) {
  const double area = base_area(scene), radius = extent_of(scene).r_end;
  const double whole = std::numbers::pi * radius * radius;
  return fmt::format("on {:.6g} cm2 along x: {:.6g} MN at {}, {:.4g} % of pi R^2 p, up to x = {}", 1e4 * area,
                     1e-6 * area * pressure, pressure_text(pressure), 100.0 * area / whole,
                     length_text(chamber_of(scene).band));
}

}  // namespace launchsafe::scene
