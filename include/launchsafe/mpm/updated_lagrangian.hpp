// The updated-Lagrangian form: explicit uGIMP on a regular background grid, in the update-stress-last form.
//
// A step takes the nodal sums that the particles left behind, updates the grid, and then passes once over all
// particles: each reads the grid, moves, updates its stress and adds itself to the next step's sums.
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/mpm/grid.hpp"
#include "launchsafe/mpm/step.hpp"
#include "launchsafe/scene/scene.hpp"

#include <vector>

namespace launchsafe::mpm {

class UpdatedLagrangian {
 public:
  /// The bodies must stay where they are.
  UpdatedLagrangian(const scene::Scene& scene, std::vector<AnyBody>& bodies);

  /// Clears the grid and gives it the particles' mass and momentum again.
  void restart();
  void press_bore(const Bore& bore) { bores_.push_back(bore); }
  /// Largest stable step (s): CFL min(dx, dr)/(c_L + |v|), times sqrt(inertial_scaling).
  double stable_time_step() const;
  StepTotals step(const Drive& drive);
  const Grid& grid() const { return grid_; }

 private:
  /// A particle whose base-side face carries the chamber pressure.
  struct LoadedFace {
    const Kinematics* body;
    std::size_t slot;
    double half_x, half_r;  ///< m
    double area;            ///< m2 per radian or metre, of the particle at rest
  };
  /// A particle of the charge bottom (without a charge, of the base) that the co-moving grid follows.
  struct Anchor {
    const Kinematics* body;
    std::size_t slot;
    double initial_x;  ///< m
  };
  /// Force per radian or metre on one node: of the chamber pressure N per Pa, of the bores N.
  struct LoadShare {
    std::size_t node;
    double force;
  };
  void locate_load();
  void locate_bores();
  double window_origin() const;
  void update_grid(const Drive& drive, NodeTotals& totals);

  const scene::Scene& scene_;
  std::vector<AnyBody>& bodies_;
  bool axisymmetric_;
  Grid grid_;
  std::vector<LoadedFace> faces_;
  std::vector<Anchor> anchors_;
  std::vector<LoadShare> load_shares_;
  std::vector<Bore> bores_;
  std::vector<LoadShare> bore_shares_;  ///< radial
  double travel_ = 0;                   ///< m, of the window's target in the lab frame
  double base_origin_ = 0;              ///< m, of the grid at rest
  double total_mass_ = 0;               ///< kg per radian or metre
};

}  // namespace launchsafe::mpm
