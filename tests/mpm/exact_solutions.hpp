// Scenes with exact solutions, and how far simulations are from these.
#pragma once

#include "launchsafe/mpm/simulation.hpp"

#include <cmath>
#include <functional>
#include <string>

namespace launchsafe::test_support {

inline constexpr scene::Formulation both_formulations[] = {scene::Formulation::total_lagrangian,
                                                           scene::Formulation::updated_lagrangian};
/// "TotalLagrangian" or "UpdatedLagrangian", for the names of tests.
std::string name_of(scene::Formulation formulation);

/// A cylinder of one material, without load.
scene::Scene block(const std::string& material, double length, double radius, double cell_size,
                   scene::Formulation formulation = scene::Formulation::total_lagrangian);
/// A pressure (Pa) that rises smoothly from 0 over `rise` (s) and then stays.
scene::Load ramp(double pressure, double rise, double duration = 1.0);
/// Weak and smooth from the first instant, with its peak (Pa) at `peak_time` (s), and done after ten times
/// that.
scene::Load pulse(double peak, double peak_time);
/// Of steel at rest, Pa.
double bulk_modulus(const scene::Steel& steel);

/// All steel under one hydrostatic pressure, compressed by `mu` (relative), at rest, with particles that
/// still tile the body. Returns the pressure (Pa).
double compress(mpm::Simulation& simulation, double mu);
/// Runs to `end` (s) in equal steps no longer than the stable one at rest; returns the step (s).
double run_to(mpm::Simulation& simulation, double end, const std::function<void()>& before_step = {});
/// Axial Cauchy stress of a steel or charge particle, tension positive, Pa.
template <class Law>
double axial_stress(const mpm::Body<Law>& body, std::size_t slot) {
  return body.deviator(slot).xx - body.particles.pressure[slot];
}

/// Collects the root mean square of what is computed less what is exact, over that of what is exact.
class RelativeError {
 public:
  void add(double computed, double exact) {
    difference_ += (computed - exact) * (computed - exact);
    scale_ += exact * exact;
  }
  double value() const { return std::sqrt(difference_ / scale_); }

 private:
  double difference_ = 0, scale_ = 0;
};

/// A pulse enters a strip of steel, 1 m long in so many cells, in a rigid barrel, where only the longitudinal
/// wave can run, and is compared with d'Alembert after 0.9 m.
struct WaveError {
  double velocity = 0, stress = 0;
};
WaveError longitudinal_error(scene::Formulation formulation, int cells);

/// Relative error of the temperature rise in a half space of charge whose face is 1 K hotter, as it meets
/// another one that is 2 K hotter, after 1 ms, in cells of `cell` (m) and so many equal steps: strips of 0.1
/// mm, eleven diffusion lengths.
double half_space_error(double cell, int steps);
inline constexpr double half_space_duration = 1e-3, half_space_depth = 1e-4;  // s, m
scene::Scene half_space(double cell);

}  // namespace launchsafe::test_support
