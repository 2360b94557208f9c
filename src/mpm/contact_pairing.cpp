#include "launchsafe/mpm/contact.hpp"

namespace launchsafe::mpm {
namespace {

/// Pieces and shares below this part of a whole are round-off of places, and left out.
constexpr double least_piece = 1e-9, least_share = 1e-12;

/// A cell of the own face, between two of its nodes.
struct FaceCell {
  std::size_t first;                  ///< node at its begin
  double begin, end;                  ///< m, along
  double measure[2];                  ///< m or 1: the radius at both ends
  double covered_begin, covered_end;  ///< m, the part that the other face meets
  bool whole;                         ///< the other face meets all of it
  int keeper;                         ///< where not whole: the end (0 or 1) whose node takes all traction

  double length() const { return end - begin; }
  double right(double place) const { return (place - begin) / length(); }  ///< hat function of the end
  double measure_at(double place) const { return measure[0] + (measure[1] - measure[0]) * right(place); }
};

double measure_at_node(const FaceLine& line, std::size_t node, FaceMeasure measure) {
  if (measure == FaceMeasure::unit_depth) return 1.0;
  return measure == FaceMeasure::radius_across ? line.across[node] : line.along[node];
}

FaceCell face_cell(const FaceLine& own, const FaceLine& other, FaceMeasure measure, std::size_t first) {
  FaceCell cell{first,
                own.along[first],
                own.along[first + 1],
                {measure_at_node(own, first, measure), measure_at_node(own, first + 1, measure)},
                0.0,
                0.0,
                true,
                0};
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

void pair_faces(const FaceLine& own, const FaceLine& other, FaceMeasure measure, std::vector<PairRow>& rows) {
  const std::size_t nodes = own.along.size();
  rows.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    PairRow& row = rows[i];
    row.own.clear();
    row.other.clear();
    row.area = row.slope = 0.0;
    if (i > 0) add_cell(face_cell(own, other, measure, i - 1), 1, other, row);
    if (i + 1 < nodes) add_cell(face_cell(own, other, measure, i), 0, other, row);
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
