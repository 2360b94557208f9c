// Heat conduction through all bodies, as an operator beside the step: the module run applies it every so
// often.
//
// It is a finite-volume scheme on the bodies' own lattices, not on the background grid. Through the
// background grid a particle would receive increments of nodal means, and what varies from one particle to
// the next within a cell is invisible to those means: it would neither decay nor stay within the initial
// extremes. Neighbours in a lattice stay neighbours, and bodies are bonded, so the links between particles
// are fixed. They are taken at rest; strain changes them by its own order.
#pragma once

#include "launchsafe/mpm/simulation.hpp"

#include <Eigen/SparseCore>

namespace launchsafe::mpm {

/// Backward Euler in time: stable and free of new extremes for any step, conserves heat, first order in the
/// step. Second order in the particle spacing. All outer faces are adiabatic.
class Conduction {
 public:
  explicit Conduction(const Simulation& simulation);

  /// Conducts over dt > 0 (s) and refreshes what the steel keeps of its temperature.
  void advance(Simulation& simulation, double dt);

 private:
  Eigen::VectorXd capacity_;                 ///< J/K by particle, body after body
  Eigen::SparseMatrix<double> conductance_;  ///< W/K, symmetric, rows sum to 0
};

}  // namespace launchsafe::mpm
