// Faces that can part and slide, as a stage of the total-Lagrangian step beside the tie.
//
// It acts once all nodes have moved freely. Every node of the charge's face has one pair of impulses, along
// the normal and along the face, which act on it and on the nodes of the other face that it meets (see
// contact_pairing.hpp) with opposite signs. The normal one keeps the gap at the step's end from falling below
// 0 and never pulls; the one along the face stops sliding as far as friction times the step's own normal
// impulse allows. A node at an edge that two faces share obeys both, each by its own rows.
//
// Nodal velocities come from particles and do not agree to the last digit between two faces even where they
// are bonded. There, momentum is first exchanged so that they do, as a tie does. That exchange is no force:
// it changes neither particles nor energies. Where faces can slide, the impulses correct it.
//
// Pairs and normals are those of the last pairing, and a gap is the mean over what a node's traction acts on.
// Pairing anew finds gaps a little different: by 1e-9 m on a launch in its barrel, 1e-7 m where a wall
// without one bends. To take an overlap back is work that contact gives: up to 4e-6 of the energy there.
// Where a bulging face slides past the other one's end, the mean is over ever less of a cell, and it gives or
// takes the force on the cell times the bulge's height in it: 1e-3 of the energy of a charge longer than its
// wall, on 5 mm.
//
// A step's impulse J on a pair works J (v_before + v_after)/2, with the relative velocities that the step
// before and this one move by: that closes the leapfrog balance to round-off. A pair that closes exactly
// takes J gap_before/(2 dt) >= 0 out of it.
#pragma once

#include "launchsafe/math/aligned_array.hpp"
#include "launchsafe/math/pack.hpp"
#include "launchsafe/mpm/contact_pairing.hpp"
#include "launchsafe/mpm/nodes.hpp"
#include "launchsafe/mpm/step.hpp"
#include "launchsafe/scene/scene.hpp"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace launchsafe::mpm {

/// A node of a face that can slide, for reports and tests. Tractions are those of the last step.
struct FaceState {
  double place = 0;          ///< m, at rest: x along a side, r along an end
  double area = 0;           ///< m2 per radian or metre, 0 where it meets nothing
  double gap = 0;            ///< m
  double pressure = 0;       ///< Pa, compression positive
  double shear = 0;          ///< Pa, on the other body: along x on a side, along r on an end
  double sliding_speed = 0;  ///< m/s, of the other body against the charge, in the same direction
  double friction_heat = 0;  ///< J/m2, since the start
  double slid = 0;           ///< m, since the start, to and fro added up
  double largest_gap = 0;    ///< m, since the start
  double overlap = 0;        ///< m, the largest since the start
  bool bonded = false;
};

class Contact {
 public:
  /// Contact of all interfaces of the scene that can slide. `lines` are those of `nodes`.
  Contact(const scene::Scene& scene, const scene::GridLines& lines, const std::vector<Nodes>& nodes,
          const std::vector<Tie>& ties);

  /// Whether any faces can slide; if none can, nothing else may be called.
  bool any() const { return !faces_.empty(); }
  /// Takes the nodes' velocities as those of the step before, which had no impulses. Broken bonds stay so.
  void reset(const std::vector<Nodes>& nodes);
  /// Acts on nodes that a step of dt (s) has moved freely, with damping that kept the share `damping_factor`
  /// of their velocity. Tractions are those that the step would have had to apply before damping, as it does
  /// forces.
  ContactTotals act(std::vector<Nodes>& nodes, double dt, double damping_factor);

  /// Faces in the order of the scene's interfaces.
  std::size_t faces() const { return faces_.size(); }
  /// Index into Scene::interfaces of a face.
  std::size_t interface_of(std::size_t face) const { return faces_[face].interface; }
  bool is_along_x(std::size_t face) const { return faces_[face].along_x; }
  /// m, at rest: r of a side, x of an end.
  double face_at(std::size_t face) const { return faces_[face].own.across_rest; }
  /// Work of friction on a face since the start, J per radian or metre, turned into heat.
  double friction_work(std::size_t face) const;
  std::vector<FaceState> state_of(std::size_t face) const;

 private:
  struct Velocity {
    double x, r;
  };
  /// A point is a node, or all nodes of a tie: they move alike.
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
    double outward;  ///< 1 or -1: from the charge, across the face
    FaceMeasure measure;
    std::size_t first_row = 0;  ///< of as many rows as the own side has nodes
    FaceSide own, other;
  };
  struct Share {
    std::uint32_t point;
    double share;           ///< in the relative velocity, other face less own one
    double give_x, give_r;  ///< 1/kg, velocity that a unit impulse of the row gives to the point
  };
  /// A node of the charge's face with what it meets.
  struct Row {
    std::uint32_t begin = 0, end = 0;   ///< in shares_
    double normal_x = 0, normal_r = 0;  ///< from the charge to the other body
    double friction = 0;
    double inertia = 0, normal_inertia = 0,
           slide_inertia = 0;  ///< kg: impulse for a unit of relative velocity, were all free to move, along
                               ///< the normal and across it
    double area = 0;
    double gap = 0;                                   ///< m, at the begin of the step
    double target = 0;                                ///< m/s, least opening speed
    double normal = 0, slide = 0;                     ///< kg m/s, impulses of the step, positive as pressure
    double last_slide = 0;                            ///< of the step before
    double tension_strength = 0, shear_strength = 0;  ///< Pa, while bonded
    double opening = 0, sliding = 0;                  ///< m/s, at the end of the last step
    double friction_work = 0;                         ///< J
    double friction_heat = 0;                         ///< J/m2
    double slid = 0, largest_gap = 0, overlap = 0;    ///< m, see FaceState
    bool bonded = false;
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
  void exchange_impulse(const Row& row, double normal, double slide);
  void make_fields(const std::vector<Nodes>& nodes);
  void read_nodes(const std::vector<Nodes>& nodes);
  void exchange_momentum();
  void begin_impulses(double step_ratio);
  void solve_impulses(double dt);
  double sweep();
  bool break_bonds(double dt);
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
  Field mobility_;                    ///< 1/kg, how readily a point moves; 0 where it is held along r
  Field unconstrained_;               ///< 1, or 0 where it is held along r
  Field velocity_;                    ///< m/s, which the step moves by
  Field free_velocity_;               ///< m/s, without contact
  Field particle_velocity_;           ///< m/s, summed from the particles
  Field exchanged_velocity_;          ///< m/s, the same after the exchange
  Field start_;                       ///< m/s, of the free motion after it
  Field before_;                      ///< m/s, which the last step moved by
  Field impulse_;                     ///< kg m/s, of the last step
  double last_dt_ = 0;                ///< s
  double damping_factor_ = 1;         ///< share of the velocity that damping leaves
  double damping_factor_before_ = 1;  ///< the same of the last step
  double slid_ = 0;                   ///< m, since the faces were paired
  double shortest_cell_ = 0;          ///< m, of the faces
  int steps_ = 0;  ///< since the faces were paired; their impulses are known by point from 1 on
  bool has_bonds_ = false;
};

}  // namespace launchsafe::mpm
