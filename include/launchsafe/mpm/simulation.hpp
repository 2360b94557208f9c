// The launch as a material point computation: explicit uGIMP in the update-stress-last form.
//
// A step takes the nodal sums that the particles left behind, updates the grid, and then passes once over all
// particles: each reads the grid, moves, updates its stress and adds itself to the next step's sums. One pass
// over the particle data a step is what makes it fast.
#pragma once

#include "launchsafe/mpm/body_step.hpp"
#include "launchsafe/mpm/grid.hpp"
#include "launchsafe/mpm/particles.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/scene.hpp"

#include <vector>

namespace launchsafe::mpm {

/// Energy balance since the start, J per radian (axisymmetric) or per metre of depth.
struct EnergyTotals {
  /// Of the motion relative to the mass centre, with scaled inertia, centred in time: velocities live half a
  /// step away from stresses (leapfrog), and m v_old v_new/2 is what the discrete work balances.
  double kinetic = 0;
  double internal = 0, external = 0, body_force = 0, damping = 0;
  double plastic = 0, viscous = 0, crack = 0;
};

/// Particle-steps on which a limiter acted or a particle was off the grid.
struct EventCounts {
  double tension_cutoff = 0, hugoniot_guard = 0, crack_at_bound = 0, off_grid = 0;
};

class Simulation {
 public:
  explicit Simulation(scene::Scene scene);
  // Loaded faces and anchors point into the bodies.
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Stable time step (s) for the present state: CFL min(dx, dr)/(c_L + |v|), times sqrt(inertial_scaling).
  double stable_time_step() const;
  /// Advances by dt > 0 (s).
  void step(double dt);

  double time() const { return time_; }
  const scene::Scene& scene() const { return scene_; }
  double chamber_pressure() const { return load_.at(time_); }  ///< Pa
  /// Acceleration (m/s2) of the co-moving frame at a time; 0 in the lab frame.
  double frame_acceleration(double time) const;
  /// The balance at the begin of the last step, where all its parts are known at one time.
  const EnergyTotals& energy() const { return balance_; }
  const EventCounts& events() const { return events_; }
  /// Kinetic energy of the particles relative to the frame with scaled inertia, J per radian or metre.
  double kinetic_energy() const;
  /// Axial momentum relative to the frame, kg m/s per radian or metre.
  double axial_momentum() const;
  /// Particles that carry mass.
  std::uint64_t particles() const { return particles_; }

  std::vector<SteelBody>& steel() { return steel_; }
  const std::vector<SteelBody>& steel() const { return steel_; }
  std::vector<ChargeBody>& charges() { return charges_; }
  const std::vector<ChargeBody>& charges() const { return charges_; }
  const Grid& grid() const { return grid_; }
  bool axisymmetric() const { return scene_.symmetry == scene::Symmetry::axisymmetric; }
  /// Calls f(kinematics) for every body, in the order of Scene::bodies within each material.
  template <class F>
  void for_each_body(F&& f) const {
    for (const SteelBody& body : steel_) f(body.kinematics);
    for (const ChargeBody& body : charges_) f(body.kinematics);
  }
  /// Clears the grid and gives it the particles' mass and momentum again: after a test has set velocities.
  void restart();
  /// Puts a steady pressure (Pa) on the inner radial face of a body (index into Scene::bodies) from now on.
  /// Its work counts as external. No scene asks for it; the thick-walled tube of `launchsafe verify` does.
  void press_bore(int body, double pressure);

 private:
  /// A particle whose base-side face carries the chamber pressure.
  struct LoadedFace {
    const Kinematics* body;
    std::size_t slot;
    double area;  ///< m2 per radian or metre, of the particle at rest
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
  /// A body whose inner radial face carries a pressure.
  struct Bore {
    const Kinematics* body;
    double pressure;  ///< Pa
  };
  void locate_load();
  void locate_bores();
  double window_origin() const;
  void update_grid(double dt);
  StepContext context_of(double dt) const;

  scene::Scene scene_;
  scene::PressureHistory load_;
  Grid grid_;
  std::vector<SteelBody> steel_;
  std::vector<ChargeBody> charges_;
  std::vector<LoadedFace> faces_;
  std::vector<Anchor> anchors_;
  std::vector<LoadShare> load_shares_;
  std::vector<Bore> bores_;
  std::vector<LoadShare> bore_shares_;  ///< radial
  double total_mass_ = 0;               ///< kg per radian or metre
  double loaded_area_ = 0;              ///< m2 per radian or metre
  double time_ = 0;
  double travel_ = 0;       ///< m, of the window's target in the lab frame
  double base_origin_ = 0;  ///< m, of the grid at rest
  std::uint64_t particles_ = 0;
  EnergyTotals energy_;      ///< at the present time, without the kinetic energy
  double bulk_kinetic_ = 0;  ///< of the mass centre, centred in the last step
  EnergyTotals balance_;     ///< at the begin of the last step
  EventCounts events_;
};

}  // namespace launchsafe::mpm
