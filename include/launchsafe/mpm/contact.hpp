// Contact of faces that can separate and slide: one stage of the total-Lagrangian step, beside the ties.
//
// The stage follows the free motion of all nodes. Every node of the charge's face has two impulses (kg m/s
// per radian), one along the normal of the face and one along the face. They act on this node and,
// with the opposite sign, on the nodes of the other face that `pair_faces` pairs it with. The normal
// impulse is the smallest one >= 0 with which the gap at the end of the step is >= 0. The impulse along the
// face stops the sliding, or is the coefficient of friction times the normal impulse of the same step where
// that is less (Coulomb). A node at a corner of two faces is subject to the conditions of both.
//
// Pairs and normals stay from one pairing to the next, and a gap is the mean over the part of the face on
// which the node's traction acts. A new pairing changes the gaps by 1e-9 m in a launch within the barrel and
// by 1e-7 m where a wall without a barrel bends. Removing such an overlap does work, up to 4e-6 of the energy
// in these launches. Where a bulging face slides past the end of the other face, the mean is taken over a
// decreasing part of a cell, and the energy changes by the force on the cell times the height of the bulge in
// it: 1e-3 of the energy for a charge longer than its wall, on cells of 5 mm.
//
// An impulse J on a pair does the work J (v_before + v_after)/2, with the relative velocities at which the
// last step and this one move: with these the leapfrog energy balance holds to round-off. A pair whose gap
// becomes exactly 0 takes J gap_before/(2 dt) >= 0 out of the energy.
#pragma once

#include "launchsafe/mpm/nodes.hpp"
#include "launchsafe/mpm/step.hpp"

#include <map>

namespace launchsafe::mpm {

// Which nodes of two faces act on each other, and with what weight: a mortar method with dual multipliers
// (Wohlmuth 2000; Popp, Gee & Wall 2009). Every node of the own face has one traction, spread along the face
// by a function that is orthogonal to the face's own hat functions. Integrals run over the pieces that the
// nodes of both faces cut from each other at their present places, so that a uniform traction gives every
// node of both faces exactly its share, however the two are divided; and nodes that coincide act on each
// other alone.

/// The nodes of one face in order. `along` increases along the face, `across` is the other direction; m.
struct FaceLine {
  std::vector<double> along, across;
};

/// A node and its share in the relative displacement of a row, other face less own face.
struct PairShare {
  std::size_t node;  ///< index into the face's line
  double share;
};

/// The pairing of one node of the own face. Shares of the own face and of the other one sum to 1 each.
struct PairRow {
  std::vector<PairShare> own, other;
  /// m2 per radian, over which the node's traction acts; 0: it is paired with no node
  double area = 0;
  double slope = 0;  ///< d across / d along of the other face there
};

/// Part of a cell by which the own face may reach over the end of the other one and still be held by it
/// whole.
inline constexpr double held_overhang = 0.1;

/// Pairs two faces at their present places. `along_x`: they run along x, so that the radius, which an area is
/// made of, is across them. One row a node of the own face; `rows` is used again without allocation once it
/// has had the size.
void pair_faces(const FaceLine& own, const FaceLine& other, bool along_x, std::vector<PairRow>& rows);

/// A node of a face that can slide, for reports and tests. Tractions are those of the last step.
struct FaceState {
  double place = 0;     ///< m, at rest: x along a side, r along an end
  double x = 0, r = 0;  ///< m, at present
  double area = 0;      ///< m2 per radian, 0 where it meets nothing
  double gap = 0;       ///< m
  double pressure = 0;  ///< Pa, compression positive
  double shear = 0;     ///< Pa, on the other body: along x on a side, along r on an end
  double slip = 0;      ///< m, by which the other body has slid since the start, in the direction of `shear`
  double overlap = 0;   ///< m, the largest since the start
};

class Contact {
 public:
  /// Contact of all interfaces of the scene that can slide. `lines` are those of `nodes`.
  Contact(const scene::Scene& scene, const scene::GridLines& lines, const std::vector<Nodes>& nodes,
          const std::vector<Tie>& ties);

  /// Whether any faces can slide; if none can, nothing else may be called.
  bool any() const { return !faces_.empty(); }
  /// Takes the nodes' velocities as those of the step before, without impulses.
  void reset(const std::vector<Nodes>& nodes);
  /// Acts on nodes that a step has moved freely. Tractions are those that the step would have had to apply,
  /// for as long as it does forces, before damping.
  ContactTotals act(std::vector<Nodes>& nodes, const StepInput& step);

  /// Faces in the order of the scene's interfaces.
  std::size_t faces() const { return faces_.size(); }
  /// Index into Scene::interfaces of a face.
  std::size_t interface_of(std::size_t face) const { return faces_[face].interface; }
  /// By node of the charge's face; `nodes` are those of the bodies at present.
  std::vector<FaceState> state_of(std::size_t face, const std::vector<Nodes>& nodes) const;

 private:
  struct Velocity {
    double x, r;
  };
  /// A point is a node, or all nodes of a tie, which have one velocity.
  struct Member {
    std::size_t nodes, index, point;
  };
  /// A quantity of all points, x and r of each in turn, padded to whole Packs.
  class Field {
   public:
    void resize(std::size_t points) {
      values_.assign((2 * points + math::pack_width - 1) / math::pack_width * math::pack_width, 0.0);
    }
    double& x(std::size_t point) { return values_[2 * point]; }
    double& r(std::size_t point) { return values_[2 * point + 1]; }
    double x(std::size_t point) const { return values_[2 * point]; }
    double r(std::size_t point) const { return values_[2 * point + 1]; }
    std::size_t size() const { return values_.size(); }
    Pack load(std::size_t i) const { return Pack::load(&values_[i]); }
    void store(std::size_t i, Pack value) { value.store(&values_[i]); }

   private:
    math::AlignedArray values_;
  };
  /// The nodes of one body along a face.
  struct FaceSide {
    std::size_t nodes = 0;             ///< index into the bodies' nodes
    std::vector<std::size_t> indices;  ///< of the nodes, in order
    std::vector<std::size_t> points;
    std::vector<double> rest;   ///< m, along the face
    double across_rest = 0;     ///< m
    FaceLine line;              ///< present places
    std::vector<double> shift;  ///< m, displacement across the face
  };
  struct Face {
    std::size_t interface;
    bool along_x;
    double outward;             ///< 1 or -1: from the charge, across the face
    std::size_t first_row = 0;  ///< of as many rows as the own side has nodes
    FaceSide own, other;
  };
  struct Share {
    std::uint32_t point;
    double share;           ///< in the relative velocity, other face less own one
    double give_x, give_r;  ///< 1/kg, velocity of the point from a unit impulse of the row
  };
  /// A node of the charge's face with the points that it is paired with.
  struct Row {
    std::uint32_t begin = 0, end = 0;   ///< in shares_
    double normal_x = 0, normal_r = 0;  ///< from the charge to the other body
    double friction = 0;
    /// kg, impulse per unit of relative velocity along the normal and along the face.
    double normal_inertia = 0, slide_inertia = 0;
    double area = 0;
    double gap = 0;                   ///< m, at the begin of the step
    double target = 0;                ///< m/s, least opening speed
    double normal = 0, slide = 0;     ///< kg m/s, impulses of the step, positive as pressure
    double opening = 0, sliding = 0;  ///< m/s, at the end of the last step
    double slip = 0, overlap = 0;     ///< m, see FaceState; the slip in the row's direction
  };

  void add_face(const scene::Scene& scene, const scene::GridLines& lines, const std::vector<Nodes>& nodes,
                const std::vector<Tie>& ties, std::size_t own, std::size_t other);
  void pair(const std::vector<Nodes>& nodes);
  FaceSide face_side(const scene::GridLines& lines, const std::vector<Nodes>& nodes,
                     const std::vector<Tie>& ties, std::size_t of, Side side);
  std::size_t point_of(const std::vector<Tie>& ties, Tie::Member node);
  void pair_face(Face& face, const std::vector<Nodes>& nodes);
  void set_row(const Face& face, std::size_t node, const PairRow& paired, Row& row);
  double least_opening(double gap) const;
  Velocity relative(const Row& row, const Field& velocity) const;
  void set_speeds(Row& row) const;
  Velocity impulse(const Row& row, double normal, double slide) const;
  void push(const Row& row, double normal, double slide);
  void make_fields(const std::vector<Nodes>& nodes);
  void read_nodes(const std::vector<Nodes>& nodes);
  void begin_impulses(double step_ratio);
  void solve_impulses(double dt);
  double sweep();
  ContactTotals add_up_energy();
  void write_nodes(std::vector<Nodes>& nodes, double dt) const;
  void advance_rows(double dt);

  std::vector<Face> faces_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> tie_of_, point_of_;  ///< by nodes and index
  std::size_t points_ = 0;
  std::vector<Member> members_;  ///< by nodes
  std::vector<Row> rows_;
  std::vector<Share> shares_;
  std::vector<PairRow> paired_;       ///< of one face, used again
  Field inertia_;                     ///< kg
  Field mass_;                        ///< kg, along x alone
  Field mobility_;                    ///< 1/kg, inverse of inertia_; 0 where the point is held along r
  Field unconstrained_;               ///< 1, or 0 where it is held along r
  Field velocity_;                    ///< m/s, which the step moves by
  Field free_velocity_;               ///< m/s, without contact
  Field particle_velocity_;           ///< m/s, summed from the particles
  Field before_;                      ///< m/s, which the last step moved by
  Field impulse_;                     ///< kg m/s, of the last step
  double last_dt_ = 0;                ///< s
  double damping_factor_ = 1;         ///< share of the velocity that damping leaves
  double damping_factor_before_ = 1;  ///< the same of the last step
  double slid_ = 0;                   ///< m, since the faces were paired
  double shortest_cell_ = 0;          ///< m, of the faces
  int steps_ = 0;  ///< since the faces were paired; their impulses are known by point from 1 on
};

}  // namespace launchsafe::mpm
