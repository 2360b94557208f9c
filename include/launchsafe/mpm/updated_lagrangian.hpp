// The updated-Lagrangian form: explicit uGIMP on a regular background grid, in the update-stress-last form.
//
// A step takes the nodal sums of the step before, updates the grid velocities, and then passes once over all
// particles: each interpolates the grid velocities, moves, updates its stress and adds to the next step's
// sums.
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/mpm/step.hpp"
#include "launchsafe/mpm/transfer.hpp"

namespace launchsafe::mpm {

class UpdatedLagrangian {
 public:
  /// Holds references to scene and bodies, which must outlive it at the same address.
  UpdatedLagrangian(const scene::Scene& scene, std::vector<AnyBody>& bodies);

  /// Clears the grid and sums the particles' mass and momentum on it again.
  void reset_grid();
  /// Largest stable step (s): CFL min(dx, dr)/(c_L + |v|), times sqrt(inertial_scaling).
  double stable_time_step() const;
  StepTotals step(const StepInput& input);
  /// Forces that are added to its nodes before a step act in it.
  Grid& grid() { return grid_; }

 private:
  /// A particle whose base-side face carries the chamber pressure.
  struct LoadedFace {
    const ParticleFields* body;
    std::size_t slot;
    double area;  ///< m2 per radian, of the particle at rest
  };
  /// A particle of the charge bottom (without a charge, of the base) that the grid follows.
  struct Anchor {
    const ParticleFields* body;
    std::size_t slot;
    double initial_x;  ///< m
  };
  /// Force of the chamber pressure on one node, N per Pa, per radian.
  struct LoadShare {
    std::size_t node;
    double force;
  };
  void locate_load();
  double window_origin() const;
  void update_grid(const StepInput& input, NodeTotals& totals);

  const scene::Scene& scene_;
  std::vector<AnyBody>& bodies_;
  Grid grid_;
  std::vector<LoadedFace> faces_;
  std::vector<Anchor> anchors_;
  std::vector<LoadShare> load_shares_;
  double base_origin_ = 0;  ///< m, of the grid at rest
  double total_mass_ = 0;   ///< kg per radian
};

}  // namespace launchsafe::mpm
