// Nodes of one body on the shared rectilinear lattice, and the tie of nodes that lie at one place.
#pragma once

#include "launchsafe/scene/plan.hpp"

namespace launchsafe::mpm {

/// Sums over the particles at the nodes of a body. A row of cells contributes to the node rows on both sides
/// of it, to each side in its own array, so that no node row has two writers and the order of addition is
/// fixed for any number of threads. A node's sum is `Nodes::inside` (of the cells towards the axis) plus
/// `Nodes::outside` (of the cells away from it).
struct NodeSums {
  math::AlignedArray momentum_x, momentum_r;  ///< kg m/s, of the inertial mass
  math::AlignedArray force_x, force_r;        ///< N, internal
};

/// Nodal fields of one body; row j of nodes begins at j * stride. Per radian.
struct Nodes {
  int body = 0;                             ///< index into Scene::bodies
  int columns = 0, rows = 0;                ///< of nodes
  int first_x = 0, first_r = 0;             ///< index of the first line in the lattice
  std::size_t stride = 0;                   ///< columns, padded to whole Packs with one to spare
  NodeSums inside, outside;                 ///< from the cells towards the axis and away from it
  math::AlignedArray mass;                  ///< kg, of this body
  math::AlignedArray inertia_x, inertia_r;  ///< kg, of this body, with inertial factors
  /// 1/kg, of all that is tied at the place; 0 beyond the body
  math::AlignedArray inverse_inertia_x, inverse_inertia_r;
  math::AlignedArray mass_share;     ///< true over inertial mass along x of all that is tied at the place
  math::AlignedArray radially_free;  ///< 1 where v_r is free, 0 on the axis and at the barrel
  math::AlignedArray velocity_x, velocity_r;  ///< m/s, at the end of the step; displacements advance with it
  math::AlignedArray velocity_increment_x, velocity_increment_r;  ///< m/s, over the step
  math::AlignedArray displacement_x, displacement_r;              ///< m, since the start

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i);
  }
  /// The sums that the particles overwrite in every step at row j: loads added to them act for one step.
  NodeSums& written(int j) { return j == 0 ? outside : inside; }
};

/// Nodes for a body's particles, at rest.
Nodes make_nodes(const scene::Scene& scene, const scene::GridLines& lines, int body);

/// Nodes of several bodies at one place.
struct Tie {
  struct Member {
    std::size_t nodes;  ///< index into the bodies' nodes
    std::size_t index;  ///< of the node
    int row;
  };
  std::vector<Member> members;
};
/// Ties of all bodies that meet at a place. Where `parts(a, b)` (indices of two bodies' nodes) says that
/// their faces can separate, only those bodies are tied that share a face which cannot, directly or through
/// others.
std::vector<Tie> find_ties(const std::vector<Nodes>& nodes,
                           const std::function<bool(std::size_t, std::size_t)>& parts);

/// The side of a body's nodes that faces another body: they share more than a point of it.
enum class Side { none, x_begin, x_end, r_begin, r_end };
Side side_towards(const Nodes& of, const Nodes& other);

/// Gives every member of a tie the sum over all members, so that all have the same velocity.
void bond(const std::vector<Tie>& ties, std::vector<Nodes>& nodes);

}  // namespace launchsafe::mpm
