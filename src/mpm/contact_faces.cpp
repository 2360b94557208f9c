// Contact's faces: which nodes they are made of, and how they are paired at present.
#include "launchsafe/mpm/contact.hpp"

namespace launchsafe::mpm {
namespace {

/// A relative motion that so little of the inverse inertia takes part in cannot be changed: both nodes are
/// held, or are one.
constexpr double least_mobility = 1e-9;

Side opposite(Side side) {
  constexpr std::array all{Side::none, Side::x_end, Side::x_begin, Side::r_end, Side::r_begin};
  return all[static_cast<std::size_t>(side)];
}

bool runs_along_x(Side side) { return side == Side::r_begin || side == Side::r_end; }

}  // namespace

Contact::Contact(const scene::Scene& scene, const scene::GridLines& lines, const std::vector<Nodes>& nodes,
                 const std::vector<Tie>& ties) {
  for (std::size_t t = 0; t < ties.size(); ++t)
    for (const Tie::Member& m : ties[t].members) tie_of_[{m.nodes, m.index}] = t;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const scene::Interface* faces = scene::interface_between(scene, a, b);
      if (faces == nullptr || !scene::can_slide(*faces)) continue;
      const bool a_is_named = scene.bodies[a].name == faces->body;
      add_face(scene, lines, nodes, ties, a_is_named ? b : a, a_is_named ? a : b);
    }
  if (!any()) return;
  shortest_cell_ = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_)
    for (const FaceSide* side : {&face.own, &face.other})
      for (std::size_t i = 0; i + 1 < side->rest.size(); ++i)
        shortest_cell_ = std::min(shortest_cell_, side->rest[i + 1] - side->rest[i]);
  make_fields(nodes);
  shares_.reserve(16 * rows_.size());
}

std::size_t Contact::point_of(const std::vector<Tie>& ties, Tie::Member node) {
  const auto known = point_of_.find({node.nodes, node.index});
  if (known != point_of_.end()) return known->second;
  const auto tie = tie_of_.find({node.nodes, node.index});
  const std::vector<Tie::Member> alone{node};
  const std::vector<Tie::Member>& members = tie == tie_of_.end() ? alone : ties[tie->second].members;
  for (const Tie::Member& m : members) {
    members_.push_back({m.nodes, m.index, points_});
    point_of_[{m.nodes, m.index}] = points_;
  }
  return points_++;
}

void Contact::make_fields(const std::vector<Nodes>& nodes) {
  std::stable_sort(members_.begin(), members_.end(),
                   [](const Member& a, const Member& b) { return a.nodes < b.nodes; });
  for (Field* field : {&inertia_, &mass_, &mobility_, &unconstrained_, &velocity_, &free_velocity_,
                       &particle_velocity_, &before_, &impulse_})
    field->resize(points_);
  for (std::size_t p = 0; p < points_; ++p) unconstrained_.x(p) = unconstrained_.r(p) = 1.0;
  for (const Member& m : members_) {
    const Nodes& n = nodes[m.nodes];
    inertia_.x(m.point) += n.inertia_x[m.index];
    inertia_.r(m.point) += n.inertia_r[m.index];
    mass_.x(m.point) += n.mass[m.index];
    unconstrained_.r(m.point) *= n.radially_free[m.index];
    mobility_.x(m.point) = n.inverse_inertia_x[m.index];
    mobility_.r(m.point) = n.inverse_inertia_r[m.index] * unconstrained_.r(m.point);
  }
}

Contact::FaceSide Contact::face_side(const scene::GridLines& lines, const std::vector<Nodes>& nodes,
                                     const std::vector<Tie>& ties, std::size_t of, Side side) {
  const Nodes& n = nodes[of];
  const bool along_x = runs_along_x(side);
  const int column = side == Side::x_end ? n.columns - 1 : 0, row = side == Side::r_end ? n.rows - 1 : 0;
  FaceSide face;
  face.nodes = of;
  for (int k = 0; k < (along_x ? n.columns : n.rows); ++k) {
    const int i = along_x ? k : column, j = along_x ? row : k;
    face.indices.push_back(n.index(i, j));
    face.points.push_back(point_of(ties, {of, n.index(i, j), j}));
    face.rest.push_back(along_x ? lines.x[static_cast<std::size_t>(n.first_x + i)]
                                : lines.r[static_cast<std::size_t>(n.first_r + j)]);
  }
  face.across_rest = along_x ? lines.r[static_cast<std::size_t>(n.first_r + row)]
                             : lines.x[static_cast<std::size_t>(n.first_x + column)];
  face.line.along = face.rest;
  face.line.across.assign(face.rest.size(), face.across_rest);
  face.shift.assign(face.rest.size(), 0.0);
  return face;
}

void Contact::add_face(const scene::Scene& scene, const scene::GridLines& lines,
                       const std::vector<Nodes>& nodes, const std::vector<Tie>& ties, std::size_t own,
                       std::size_t other) {
  const Side side = side_towards(nodes[own], nodes[other]);
  if (side == Side::none) return;
  const scene::Interface& law = *scene::interface_between(scene, own, other);
  Face face;
  face.interface = static_cast<std::size_t>(&law - scene.interfaces.data());
  face.along_x = runs_along_x(side);
  face.outward = side == Side::x_end || side == Side::r_end ? 1.0 : -1.0;
  face.first_row = rows_.size();
  face.own = face_side(lines, nodes, ties, own, side);
  face.other = face_side(lines, nodes, ties, other, opposite(side));
  Row row;
  row.friction = law.friction.value_or(0.0);
  rows_.resize(rows_.size() + face.own.indices.size(), row);
  faces_.push_back(std::move(face));
}

/// Pairs all faces at the places that the nodes have now.
void Contact::pair(const std::vector<Nodes>& nodes) {
  shares_.clear();
  for (Face& face : faces_) pair_face(face, nodes);
  for (Row& row : rows_) set_speeds(row);
  slid_ = 0.0;
  steps_ = 0;
}

void Contact::pair_face(Face& face, const std::vector<Nodes>& nodes) {
  for (FaceSide* side : {&face.own, &face.other}) {
    const Nodes& n = nodes[side->nodes];
    for (std::size_t k = 0; k < side->indices.size(); ++k) {
      const double x = n.displacement_x[side->indices[k]], r = n.displacement_r[side->indices[k]];
      side->line.along[k] = side->rest[k] + (face.along_x ? x : r);
      side->shift[k] = face.along_x ? r : x;
      side->line.across[k] = side->across_rest + side->shift[k];
    }
  }
  pair_faces(face.own.line, face.other.line, face.along_x, paired_);
  for (std::size_t i = 0; i < paired_.size(); ++i) set_row(face, i, paired_[i], rows_[face.first_row + i]);
}

void Contact::set_row(const Face& face, std::size_t node, const PairRow& paired, Row& row) {
  row.area = paired.area;
  row.begin = row.end = static_cast<std::uint32_t>(shares_.size());
  row.gap = 0.0;
  // A node tied to the other body, as at the corner where sliding faces end at bonded ones, does not move
  // against it: the tie holds its part of the face. Its row would turn round-off of places into any impulse.
  const bool tied = std::any_of(paired.other.begin(), paired.other.end(), [&](const PairShare& each) {
    return face.other.points[each.node] == face.own.points[node];
  });
  if (!(paired.area > 0.0) || tied) {
    row.normal = row.slide = row.normal_inertia = row.slide_inertia = 0.0;
    return;
  }
  // Where a node is held along r, on the axis or by the barrel, the face runs along a line of the grid.
  const auto held = [&](const FaceSide& side, const PairShare& each) {
    return !(unconstrained_.r(side.points[each.node]) > 0.0);
  };
  const auto any_held = [&](const FaceSide& side, const std::vector<PairShare>& shares) {
    return std::any_of(shares.begin(), shares.end(), [&](const PairShare& each) { return held(side, each); });
  };
  const double slope =
      any_held(face.own, paired.own) || any_held(face.other, paired.other) ? 0.0 : paired.slope;
  const double cosine = face.outward / std::sqrt(1.0 + slope * slope);
  const double across = cosine, along = -cosine * slope;
  row.normal_x = face.along_x ? along : across;
  row.normal_r = face.along_x ? across : along;
  const double here = face.own.line.along[node];
  const auto take = [&](const FaceSide& side, const PairShare& each, double sign) {
    const auto point = static_cast<std::uint32_t>(side.points[each.node]);
    row.gap +=
        sign * each.share * (across * side.shift[each.node] + along * (side.line.along[each.node] - here));
    for (std::size_t s = row.begin; s < shares_.size(); ++s)
      if (shares_[s].point == point) {
        shares_[s].share += sign * each.share;
        return;
      }
    shares_.push_back({point, sign * each.share, 0.0, 0.0});
  };
  for (const PairShare& each : paired.own) take(face.own, each, -1.0);
  for (const PairShare& each : paired.other) take(face.other, each, 1.0);
  row.end = static_cast<std::uint32_t>(shares_.size());
  double normal = 0.0, slide = 0.0;
  const double nx = row.normal_x * row.normal_x, nr = row.normal_r * row.normal_r;
  for (std::size_t s = row.begin; s < row.end; ++s) {
    Share& each = shares_[s];
    each.give_x = each.share * mobility_.x(each.point);
    each.give_r = each.share * mobility_.r(each.point);
    normal += each.share * (nx * each.give_x + nr * each.give_r);
    slide += each.share * (nr * each.give_x + nx * each.give_r);
  }
  const double least = least_mobility * mobility_.x(face.own.points[node]);
  const auto inertia = [least](double mobility) { return mobility > least ? 1.0 / mobility : 0.0; };
  row.normal_inertia = inertia(normal);
  row.slide_inertia = inertia(slide);
}

// --- pairing ---

namespace {

/// Pieces and shares below this part of a whole are round-off of places, and left out.
constexpr double least_piece = 1e-9, least_share = 1e-12;

/// A cell of the own face, between two of its nodes.
struct FaceCell {
  std::size_t first;                  ///< node at its begin
  double begin, end;                  ///< m, along
  double measure[2];                  ///< m, the radius at both ends
  double covered_begin, covered_end;  ///< m, the part that the other face meets
  bool whole;                         ///< the other face meets all of it
  int keeper;                         ///< where not whole: the end (0 or 1) whose node takes all traction

  double length() const { return end - begin; }
  double right(double place) const { return (place - begin) / length(); }  ///< hat function of the end
  double measure_at(double place) const { return measure[0] + (measure[1] - measure[0]) * right(place); }
};

FaceCell face_cell(const FaceLine& own, const FaceLine& other, bool along_x, std::size_t first) {
  const std::vector<double>& radius = along_x ? own.across : own.along;
  FaceCell cell{
      first, own.along[first], own.along[first + 1], {radius[first], radius[first + 1]}, 0.0, 0.0, true, 0};
  const double before = other.along.front() - cell.begin, after = cell.end - other.along.back();
  const double held = held_overhang * cell.length();
  const bool meets_begin = before <= held && cell.begin <= other.along.back() + held;
  const bool meets_end = after <= held && cell.end >= other.along.front() - held;
  cell.whole = meets_begin && meets_end;
  cell.covered_begin = cell.whole ? cell.begin : std::max(cell.begin, other.along.front());
  cell.covered_end = cell.whole ? cell.end : std::min(cell.end, other.along.back());
  const double middle = 0.5 * (cell.covered_begin + cell.covered_end);
  cell.keeper = meets_begin != meets_end ? (meets_end ? 1 : 0) : (cell.right(middle) > 0.5 ? 1 : 0);
  return cell;
}

/// The traction's function of one end's node as p[0] N_0 + p[1] N_1: orthogonal in the cell to the other
/// end's hat, with the same integral against its own as that hat has. The two ends' functions sum to 1.
std::array<double, 2> traction_function(const FaceCell& cell, int end) {
  if (!cell.whole) return {1.0, 1.0};
  const double h = cell.length(), a = cell.measure[0], b = cell.measure[1];
  const double m00 = h * (3.0 * a + b) / 12.0, m01 = h * (a + b) / 12.0, m11 = h * (a + 3.0 * b) / 12.0;
  const double determinant = m00 * m11 - m01 * m01;
  if (end == 0) return {(m00 + m01) * m11 / determinant, -(m00 + m01) * m01 / determinant};
  return {-(m01 + m11) * m01 / determinant, (m01 + m11) * m00 / determinant};
}

void add(std::vector<PairShare>& shares, std::size_t node, double share) {
  for (PairShare& each : shares)
    if (each.node == node) {
      each.share += share;
      return;
    }
  shares.push_back({node, share});
}

/// Calls f(place, weight) at points and with weights whose sum is the exact integral of cubics.
template <class F>
void integrate(double begin, double end, F&& f) {
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), offset = half / std::sqrt(3.0);
  f(middle - offset, half);
  f(middle + offset, half);
}

/// What the end's node takes over in the cell of the piece between two nodes of the other face.
void add_piece(const FaceCell& cell, const std::array<double, 2>& p, const FaceLine& other,
               std::size_t segment, double begin, double end, PairRow& row) {
  const double from = other.along[segment], length = other.along[segment + 1] - from;
  const double slope = (other.across[segment + 1] - other.across[segment]) / length;
  double left = 0.0, right = 0.0;
  integrate(begin, end, [&](double place, double weight) {
    const double own_right = cell.right(place);
    const double value = weight * cell.measure_at(place) * (p[0] * (1.0 - own_right) + p[1] * own_right);
    const double other_right = std::clamp((place - from) / length, 0.0, 1.0);
    left += value * (1.0 - other_right);
    right += value * other_right;
  });
  add(row.other, segment, left);
  add(row.other, segment + 1, right);
  row.slope += slope * (left + right);
}

/// What the node at one end of a cell meets in it.
void add_cell(const FaceCell& cell, int end, const FaceLine& other, PairRow& row) {
  if (!(cell.length() > 0.0) || !(cell.covered_end > cell.covered_begin)) return;
  if (!cell.whole && cell.keeper != end) return;
  const auto p = traction_function(cell, end);
  if (cell.whole) {
    const double a = cell.measure[0], b = cell.measure[1];
    const double own = cell.length() * (end == 0 ? 2.0 * a + b : a + 2.0 * b) / 6.0;
    add(row.own, cell.first + static_cast<std::size_t>(end), own);
    row.area += own;
  } else {
    double left = 0.0, right = 0.0;
    integrate(cell.covered_begin, cell.covered_end, [&](double place, double weight) {
      const double value = weight * cell.measure_at(place);
      left += value * (1.0 - cell.right(place));
      right += value * cell.right(place);
    });
    add(row.own, cell.first, left);
    add(row.own, cell.first + 1, right);
    row.area += left + right;
  }
  const double least = least_piece * cell.length();
  const auto& along = other.along;
  const std::size_t last = along.size() - 2;
  const auto after = std::upper_bound(along.begin(), along.end(), cell.covered_begin + least);
  std::size_t segment = after == along.begin() ? 0 : static_cast<std::size_t>(after - along.begin()) - 1;
  segment = std::min(segment, last);
  double place = cell.covered_begin;
  while (true) {
    const bool ends = segment == last || along[segment + 1] >= cell.covered_end - least;
    const double piece_end = ends ? cell.covered_end : along[segment + 1];
    if (piece_end > place) add_piece(cell, p, other, segment, place, piece_end, row);
    if (ends) break;
    place = piece_end;
    ++segment;
  }
}

/// Leaves out round-off and makes the shares' sum 1.
void normalise(std::vector<PairShare>& shares) {
  double all = 0.0;
  for (const PairShare& each : shares) all += each.share;
  std::erase_if(shares, [&](const PairShare& each) { return std::abs(each.share) < least_share * all; });
  double kept = 0.0;
  for (const PairShare& each : shares) kept += each.share;
  for (PairShare& each : shares) each.share /= kept;
}

}  // namespace

void pair_faces(const FaceLine& own, const FaceLine& other, bool along_x, std::vector<PairRow>& rows) {
  const std::size_t nodes = own.along.size();
  rows.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    PairRow& row = rows[i];
    row.own.clear();
    row.other.clear();
    row.area = row.slope = 0.0;
    if (i > 0) add_cell(face_cell(own, other, along_x, i - 1), 1, other, row);
    if (i + 1 < nodes) add_cell(face_cell(own, other, along_x, i), 0, other, row);
    if (!(row.area > 0.0)) {
      row.area = 0.0;
      row.own.clear();
      row.other.clear();
      continue;
    }
    row.slope /= row.area;
    normalise(row.own);
    normalise(row.other);
  }
}

}  // namespace launchsafe::mpm
