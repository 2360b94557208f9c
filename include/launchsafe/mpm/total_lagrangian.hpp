// The total-Lagrangian form (de Vaucorbeil, Nguyen & Hutchinson 2020): gradients and transfer refer to the
// configuration at rest, so that weights are constants of a rectilinear lattice whose lines run through every
// edge of every body, and no particle ever crosses a cell.
//
// A step has these stages: nodal forces of the chamber pressure; the ties of bodies that are bonded; the
// update of the nodal velocities; contact of faces that can slide; and one pass over the particles, which
// interpolates the nodal velocities, updates deformation and stress and sums momentum and internal force at
// the nodes for the next step. With the deformation gradient F of a particle and its Cauchy stress sigma,
// forces come from P = J sigma F^-T: f = -sum V0 P grad0 N.
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/mpm/contact.hpp"
#include "launchsafe/scene/load.hpp"

#include <memory>

namespace launchsafe::mpm {

/// Constant weights of one row of particles on the node rows towards the axis (0) and away from it (1).
struct RowWeights {
  int cell_row = 0;
  double value[2] = {0, 0};   ///< mean of the hat function over the particle, weighted with r
  double hoop[2] = {0, 0};    ///< mean of N/r, 1/m
  double inverse_length = 0;  ///< 1/m, of the cell along r
};

class TotalLagrangian {
 public:
  /// Holds references to scene and bodies, which must outlive it at the same address.
  TotalLagrangian(const scene::Scene& scene, std::vector<AnyBody>& bodies);

  /// Recomputes the nodal momenta and velocities from the particles, after velocities were set.
  void reset_grid();
  /// Largest stable step (s): CFL times the smallest height of a cell, as it is deformed, over the sound
  /// speed in it, with the inertial factors.
  double stable_time_step() const;
  StepTotals step(const StepInput& input);

  const std::vector<Nodes>& nodes() const { return nodes_; }
  /// Forces that are added to `Nodes::written` before a step act in it; the ledger does not know their work.
  std::vector<Nodes>& nodes() { return nodes_; }
  const std::vector<Tie>& ties() const { return ties_; }
  const Contact& contact() const { return *contact_; }

 private:
  /// Constants of a body.
  struct Part {
    std::vector<RowWeights> rows;
    math::AlignedArray
        inverse_length;            ///< 1/m by slot column within a sub-row, of the cell along x; 0: no cell
    math::AlignedArray hourglass;  ///< N/m by slot: kappa G V/(3 L^2), G the hourglass modulus; empty without
  };
  /// Squared frequencies of a cell at rest with its true mass, over a factor that all have in common, 1/s2:
  /// of the motion along x and along r, by stretching and by shearing it.
  struct CellRates {
    double stretch_x, shear_x, stretch_r, shear_r;
  };
  /// Force of the chamber pressure on one node, along x or r: N per Pa.
  struct LoadShare {
    std::size_t body;
    int row;
    std::size_t index;
    double force;
  };

  Part make_part(const AnyBody& any, const Nodes& nodes) const;
  void lengthen_steps();
  template <class F>
  void for_each_cell(F&& f);
  void sum_nodal_masses();
  void load_across(const scene::ChamberFace& face);
  void load_along(const scene::ChamberFace& face);
  void load_nodes(const StepInput& input);
  double chamber_flow() const;
  void move_row(Nodes& nodes, int row, const StepInput& input, NodeTotals& totals) const;
  void advance_body(std::size_t index, const StepInput& input);

  const scene::Scene& scene_;
  std::vector<AnyBody>& bodies_;
  scene::GridLines lines_;
  std::vector<Nodes> nodes_;  ///< by body
  std::vector<Part> parts_;   ///< by body
  double inertia_ = 0;        ///< kg per radian, of all bodies
  std::vector<Tie> ties_;
  std::vector<LoadShare> axial_load_, radial_load_;
  std::unique_ptr<Contact> contact_;
  ContactTotals contact_totals_;                              ///< of the step
  std::vector<std::vector<ParticleTotals>> particle_totals_;  ///< by body and row
  std::vector<std::vector<NodeTotals>> node_totals_;          ///< by body and row
  double damped_before_ = 0;                                  ///< 1/damping_factor - 1 of the last step
};

}  // namespace launchsafe::mpm
