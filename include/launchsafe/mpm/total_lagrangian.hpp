// The total-Lagrangian form (de Vaucorbeil, Nguyen & Hutchinson 2020): gradients and transfer refer to the
// configuration at rest, so that weights are constants of a rectilinear lattice whose lines run through every
// edge of every body, and no particle ever crosses a cell.
//
// A step is a row of stages: the base's and bores' pressure on the nodes, the ties between bodies that are
// bonded for good, the nodes' motion, the contact of faces that can slide, and one pass over the particles,
// which read the nodes, take on the deformation, advance their law and add themselves to the next step's
// sums. With the deformation gradient F of a particle and its Cauchy stress sigma, forces come from P = J
// sigma F^-T: f = -sum V0 P grad0 N.
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/mpm/contact.hpp"
#include "launchsafe/mpm/nodes.hpp"
#include "launchsafe/mpm/step.hpp"
#include "launchsafe/mpm/team.hpp"
#include "launchsafe/scene/scene.hpp"

#include <memory>
#include <vector>

namespace launchsafe::mpm {

/// Constant weights of one row of particles on the node rows towards the axis (0) and away from it (1).
struct RowWeights {
  int cell_row = 0;
  double value[2] = {0,
                     0};  ///< mean of the hat function over the particle, weighted with r where axisymmetric
  double hoop[2] = {0, 0};    ///< mean of N/r, 1/m; 0 in plane strain
  double inverse_length = 0;  ///< 1/m, of the cell along r
};

class TotalLagrangian {
 public:
  /// The bodies must stay where they are.
  TotalLagrangian(const scene::Scene& scene, std::vector<AnyBody>& bodies, int threads);

  /// Gives the nodes the particles' momentum again, after velocities were set.
  void restart();
  void press_bore(const Bore& bore) { bores_.push_back(bore); }
  void pull(const Pull& pull) { pulls_.push_back(pull); }
  /// Largest stable step (s): CFL times the smallest height of a cell, as it is deformed, over the sound
  /// speed in it, with the inertial factors.
  double stable_time_step() const;
  StepTotals step(const Drive& drive);

  /// Processor time (s) of the threads beside the caller's.
  double helpers_processor_time() const { return team_->helpers_processor_time(); }

  const std::vector<Nodes>& nodes() const { return nodes_; }
  const std::vector<Tie>& ties() const { return ties_; }
  const Contact& contact() const { return *contact_; }
  /// Inertial over true mass of a body.
  double inertial_factor(const Kinematics& body) const;

 private:
  /// What a body's rows share.
  struct Part {
    std::vector<RowWeights> rows;
    math::AlignedArray
        inverse_length;            ///< 1/m by slot column within a sub-row, of the cell along x; 0: no cell
    math::AlignedArray hourglass;  ///< N/m by slot: kappa G V/(3 L^2), G the hourglass modulus; empty without
    double inertial_factor = 1;
  };
  /// Rows of one body that a thread works through.
  struct Rows {
    std::size_t body;
    int begin, end;
  };
  /// Force on one node: of the chamber pressure N per Pa.
  struct LoadShare {
    std::size_t body;
    int row;
    std::size_t index;
    double force;
  };

  Part make_part(const AnyBody& any, const Nodes& nodes) const;
  void weigh_nodes();
  void share_work();
  void find_base();
  void load_nodes(const Drive& drive);
  double base_flow() const;
  double bore_work(double dt) const;
  double pull_work(double dt) const;
  template <class F>
  void for_each_bore_share(F&& f) const;
  void move_row(Nodes& nodes, int row, const Drive& drive, NodeTotals& totals) const;
  void advance_rows(const Rows& rows, const Drive& drive);
  void touch(const Drive& drive);
  void work_through(const Drive& drive);

  const scene::Scene& scene_;
  std::vector<AnyBody>& bodies_;
  bool axisymmetric_;
  scene::GridLines lines_;
  std::vector<Nodes> nodes_;  ///< by body
  std::vector<Part> parts_;   ///< by body
  double inertia_ = 0;        ///< kg per radian or metre, of all bodies
  std::vector<Tie> ties_;
  std::vector<LoadShare> base_;
  std::unique_ptr<Contact> contact_;
  ContactTotals contact_totals_;  ///< of the step
  std::vector<Bore> bores_;
  std::vector<Pull> pulls_;
  std::vector<std::vector<Rows>> particle_rows_, node_rows_;  ///< by thread
  std::vector<std::vector<ParticleTotals>> particle_totals_;  ///< by body and row
  std::vector<std::vector<NodeTotals>> node_totals_;          ///< by body and row
  double damped_before_ = 0;                                  ///< 1/keep - 1 of the last step
  std::unique_ptr<Team> team_;
  FasterWay faster_way_;
};

}  // namespace launchsafe::mpm
