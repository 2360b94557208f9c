// Which nodes of two faces act on each other, and with what weight: a mortar method with dual multipliers
// (Wohlmuth 2000; Popp, Gee & Wall 2009). Every node of the own face has one traction, spread along the face
// by a function that is orthogonal to the face's own hat functions. Integrals run over the pieces that the
// nodes of both faces cut from each other at their present places, so that a uniform traction gives every
// node of both faces exactly its share, however the two are divided; and nodes that coincide act on each
// other alone.
#pragma once

#include <cstddef>
#include <vector>

namespace launchsafe::mpm {

/// The nodes of one face in order. `along` increases along the face, `across` is the other direction; m.
struct FaceLine {
  std::vector<double> along, across;
};

/// What an area is made of along a face: of unit depth, or of a ring, with the radius across or along the
/// face.
enum class FaceMeasure { unit_depth, radius_across, radius_along };

/// A node and its share in the relative displacement of a row, other face less own face.
struct PairShare {
  std::size_t node;  ///< index into the face's line
  double share;
};

/// The pairing of one node of the own face. Shares of the own face and of the other one sum to 1 each.
struct PairRow {
  std::vector<PairShare> own, other;
  double area =
      0;  ///< m2 per radian or per metre, over which the node's traction acts; 0: it is paired with no node
  double slope = 0;  ///< d across / d along of the other face there
};

/// Part of a cell by which the own face may reach over the end of the other one and still be held by it
/// whole.
inline constexpr double held_overhang = 0.1;

/// Pairs two faces at their present places. One row a node of the own face; `rows` is used again without
/// allocation once it has had the size.
void pair_faces(const FaceLine& own, const FaceLine& other, FaceMeasure measure, std::vector<PairRow>& rows);

}  // namespace launchsafe::mpm
