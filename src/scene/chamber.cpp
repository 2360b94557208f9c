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
class CutPlane {
 public:
  explicit CutPlane(const Scene& scene) {
    std::vector<double> x, r{0.0};
    for (const Body& body : scene.bodies) {
      x.insert(x.end(), {body.x_begin, body.x_end});
      r.insert(r.end(), {body.r_begin, body.r_end});
    }
    const double tolerance = length_tolerance(scene);
    x_ = distinct(std::move(x), tolerance);
    r_ = distinct(std::move(r), tolerance);
    body_.resize(static_cast<std::size_t>(columns() * rows()));
    for (int i = 1; i + 1 < columns(); ++i)
      for (int j = 0; j < rows(); ++j)
        body_[index({i, j})] =
            body_around(scene, 0.5 * (x_begin(i) + x_end(i)), 0.5 * (r_begin(j) + r_end(j)));
  }

  int columns() const { return static_cast<int>(x_.size()) + 1; }
  int rows() const { return static_cast<int>(r_.size()) - 1; }
  int barrel_row() const { return rows() - 1; }
  bool contains(const Cell& cell) const {
    return cell.column >= 0 && cell.column < columns() && cell.row >= 0 && cell.row < rows();
  }
  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.column * rows() + cell.row);
  }
  const std::optional<std::size_t>& body(const Cell& cell) const { return body_[index(cell)]; }
  double x_begin(int column) const { return x_[static_cast<std::size_t>(column) - 1]; }
  double x_end(int column) const { return x_[static_cast<std::size_t>(column)]; }
  double r_begin(int row) const { return r_[static_cast<std::size_t>(row)]; }
  double r_end(int row) const { return r_[static_cast<std::size_t>(row) + 1]; }

 private:
  static std::optional<std::size_t> body_around(const Scene& scene, double x, double r) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Body& body = scene.bodies[b];
      if (x > body.x_begin && x < body.x_end && r > body.r_begin && r < body.r_end) return b;
    }
    return std::nullopt;
  }

  std::vector<double> x_, r_;
  std::vector<std::optional<std::size_t>> body_;  ///< by cell
};

/// Columns of cells in which the shell touches the barrel throughout.
struct FullRing {
  int first = 0, last = 0;
};

/// The foremost annulus of full radius, or the one around a stated place.
std::optional<FullRing> ring_of_band(const CutPlane& plane, const std::optional<double>& stated,
                                     double tolerance) {
  const auto is_full = [&](int column) { return plane.body({column, plane.barrel_row()}).has_value(); };
  for (int first = 1; first + 1 < plane.columns(); ++first) {
    if (!is_full(first)) continue;
    int last = first;
    while (is_full(last + 1)) ++last;
    const bool is_around =
        !stated || (*stated >= plane.x_begin(first) - tolerance && *stated <= plane.x_end(last) + tolerance);
    if (is_around) return FullRing{first, last};
    first = last;
  }
  return std::nullopt;
}

/// Cells beside one, each with the side that its body turns to it.
std::array<std::pair<Cell, BodySide>, 4> beside(const Cell& cell) {
  return {{{{cell.column - 1, cell.row}, BodySide::x_end},
           {{cell.column + 1, cell.row}, BodySide::x_begin},
           {{cell.column, cell.row - 1}, BodySide::r_end},
           {{cell.column, cell.row + 1}, BodySide::r_begin}}};
}

/// All open cells that gas reaches from some.
std::vector<Cell> filled_from(const CutPlane& plane, std::vector<Cell> cells) {
  std::vector<bool> known(static_cast<std::size_t>(plane.columns() * plane.rows()));
  for (const Cell& cell : cells) known[plane.index(cell)] = true;
  for (std::size_t next = 0; next < cells.size(); ++next)
    for (const auto& each : beside(cells[next])) {
      const Cell& cell = each.first;
      if (!plane.contains(cell) || plane.body(cell) || known[plane.index(cell)]) continue;
      known[plane.index(cell)] = true;
      cells.push_back(cell);
    }
  return cells;
}

std::vector<ChamberFace> faces_at(const CutPlane& plane, const std::vector<Cell>& gas) {
  std::vector<ChamberFace> all;
  for (const Cell& cell : gas)
    for (const auto& [neighbour, side] : beside(cell)) {
      if (!plane.contains(neighbour) || !plane.body(neighbour)) continue;
      ChamberFace face{*plane.body(neighbour), side, 0.0, 0.0};
      face.begin = face.across_x() ? plane.r_begin(cell.row) : plane.x_begin(cell.column);
      face.end = face.across_x() ? plane.r_end(cell.row) : plane.x_end(cell.column);
      all.push_back(face);
    }
  std::ranges::sort(all, [](const ChamberFace& a, const ChamberFace& b) {
    return std::tie(a.body, a.side, a.begin) < std::tie(b.body, b.side, b.begin);
  });
  std::vector<ChamberFace> joined;
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

}  // namespace

Chamber chamber_of(const Scene& scene) {
  if (scene.bodies.empty()) return {};
  const CutPlane plane(scene);
  std::vector<Cell> behind;
  for (int row = 0; row < plane.rows(); ++row) behind.push_back({plane.columns() - 1, row});
  std::vector<Cell> gas = behind;
  Chamber chamber;
  const auto annulus = ring_of_band(plane, scene.load.obturation, length_tolerance(scene));
  if (!annulus) {
    chamber.unclear = "a place where the shell does not have its full radius";
  } else {
    chamber.band = plane.x_end(annulus->last);
    for (int column = annulus->last + 1; column + 1 < plane.columns(); ++column)
      if (!plane.body({column, plane.barrel_row()})) gas.push_back({column, plane.barrel_row()});
    gas = filled_from(plane, std::move(gas));
    const bool passes = std::ranges::any_of(gas, [&](const Cell& cell) {
      return cell.column == 0 || (cell.row == plane.barrel_row() && cell.column < annulus->first);
    });
    if (passes) chamber.unclear = "a shell through which the chamber's gas passes the driving band";
  }
  chamber.faces = faces_at(plane, gas);
  const bool is_even = scene.numerics.formulation == Formulation::updated_lagrangian;
  if (chamber.unclear.empty() && is_even && !acts_on_rear_alone(scene, chamber))
    chamber.unclear = "the formulation \"updated-lagrangian\", which loads the rearmost face alone";
  for (const ChamberFace& face : chamber.faces)
    if (chamber.unclear.empty() && is_charge(scene, scene.bodies[face.body]))
      chamber.unclear =
          fmt::format("a chamber whose gas reaches the charge \"{}\"", scene.bodies[face.body].name);
  if (!chamber.unclear.empty()) chamber.faces = faces_at(plane, behind);
  return chamber;
}

bool acts_on_rear_alone(const Scene& scene, const Chamber& chamber) {
  const double rear = extent_of(scene).x_end - length_tolerance(scene);
  return std::ranges::all_of(chamber.faces, [&](const ChamberFace& face) {
    return face.side == BodySide::x_end && scene.bodies[face.body].x_end >= rear;
  });
}

std::string chamber_text(const Scene& scene, double pressure) {
  const double area = base_area(scene), radius = extent_of(scene).r_end;
  const double whole = std::numbers::pi * radius * radius;
  return fmt::format("on {:.6g} cm2 along x: {:.6g} MN at {}, {:.4g} % of pi R^2 p, up to x = {}", 1e4 * area,
                     1e-6 * area * pressure, pressure_text(pressure), 100.0 * area / whole,
                     length_text(chamber_of(scene).band));
}

}  // namespace launchsafe::scene
