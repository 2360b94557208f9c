// The launch as a material point computation, in either formulation.
#pragma once

#include "launchsafe/mpm/energy.hpp"
#include "launchsafe/mpm/total_lagrangian.hpp"
#include "launchsafe/mpm/updated_lagrangian.hpp"

namespace launchsafe::mpm {

/// Number of particle-steps on which a limiter acted, the particle was off the grid, or its cell was inverted
/// or stretched beyond what the strain measure describes.
struct EventCounts {
  double tension_cutoff = 0, pressure_guard = 0, crack_at_bound = 0, off_grid = 0, distorted = 0;
};

class Simulation {
 public:
  explicit Simulation(scene::Scene scene);
  // The formulation holds references to the bodies.
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Stable time step (s) for the present state.
  double stable_time_step() const;
  /// Advances by dt > 0 (s).
  void step(double dt);

  double time() const { return time_; }
  const scene::Scene& scene() const { return scene_; }
  double chamber_pressure() const { return pressure_; }  ///< Pa
  /// The balance at the begin of the last step, where all its parts are known at one time.
  const EnergyBalance& energy() const { return balance_; }
  const EventCounts& events() const { return events_; }
  /// Axial momentum relative to the frame, kg m/s per radian, with the inertial factors that are not common
  /// to all: what no forces between particles change.
  double axial_momentum() const;
  /// Particles that carry mass.
  std::uint64_t particles() const { return particles_; }

  /// In the order of Scene::bodies.
  std::vector<AnyBody>& bodies() { return bodies_; }
  const std::vector<AnyBody>& bodies() const { return bodies_; }
  /// The bodies of one law, in the same order.
  template <class Law>
  auto bodies_of() {
    return listed<Law, Body<Law>>(bodies_);
  }
  template <class Law>
  auto bodies_of() const {
    return listed<Law, const Body<Law>>(bodies_);
  }
  /// Calls f(particle fields) for every body, in the order of Scene::bodies.
  template <class F>
  void for_each_body(F&& f) const {
    for (const AnyBody& body : bodies_) f(particle_fields_of(body));
  }

  /// The formulation of the scene; null for the other one.
  const TotalLagrangian* total_lagrangian() const { return std::get_if<TotalLagrangian>(&form_); }
  TotalLagrangian* total_lagrangian() { return std::get_if<TotalLagrangian>(&form_); }
  UpdatedLagrangian* updated_lagrangian() { return std::get_if<UpdatedLagrangian>(&form_); }

  /// Lets a share of the mass of a charge's particle burn in the next step, into gas of `fresh_energy` (J/kg,
  /// thermal, from 0 K); beyond what is left of it nothing more does. `body`: index into Scene::bodies.
  void burn(int body, std::size_t slot, double share, double fresh_energy);
  /// False once a burning particle was in a state that the gas law does not cover.
  bool within_gas_law() const;

  /// Recomputes the nodal momenta and velocities from the particles, after velocities were set.
  void reset_grid();

 private:
  /// The bodies of a law, each as One.
  template <class Law, class One, class Bodies>
  static std::vector<std::reference_wrapper<One>> listed(Bodies& bodies) {
    std::vector<std::reference_wrapper<One>> found;
    for (auto& body : bodies)
      if (One* one = std::get_if<Body<Law>>(&body)) found.emplace_back(*one);
    return found;
  }
  void add_to_energy(const StepTotals& totals, const StepInput& begin);
  /// Of the frame, m/s2, under a pressure of the chamber (Pa).
  double acceleration_under(double pressure) const;

  scene::Scene scene_;
  scene::PressureHistory load_;
  std::vector<AnyBody> bodies_;
  std::variant<std::monostate, TotalLagrangian, UpdatedLagrangian> form_;
  double total_mass_ = 0;   ///< kg per radian
  double loaded_area_ = 0;  ///< m2 per radian
  double time_ = 0;
  double pressure_ = 0;  ///< Pa, in the chamber at the present time
  std::uint64_t particles_ = 0;
  EnergyBalance energy_;   ///< at the present time, without the kinetic energy
  EnergyBalance balance_;  ///< at the begin of the last step
  EventCounts events_;
};

}  // namespace launchsafe::mpm
