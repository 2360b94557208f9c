// The scenes that the checks of the mechanics simulate, and simulations that more than one of them makes.
#pragma once

#include "launchsafe/mpm/simulation.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace launchsafe::verify::mechanics {

/// Bore and outer radius of the thick-walled tube, m.
inline constexpr double tube_bore = 0.065, tube_outside = 0.0775;
/// A relaxed tube under 100 MPa inside.
struct Tube {
  double hoop_bore, hoop_outside;  ///< Pa
  double displacement;             ///< of the bore, without the part due to the free ends, m
};
/// With `radial_cells` from the axis to the outside.
Tube relaxed_tube(scene::Formulation formulation, int radial_cells);

/// The 155 mm shell of model section 1.
scene::Scene shell_155(double cell_size,
                       scene::Formulation formulation = scene::Formulation::total_lagrangian);
/// A cylinder or strip of one material.
scene::Scene block(const std::string& material, double length, double radius, double cell_size,
                   scene::Formulation formulation = scene::Formulation::total_lagrangian);
/// A pressure (Pa) that rises smoothly from 0 over `rise` (s) and then stays.
scene::Load ramp(double pressure, double rise, double duration);
/// Of steel at rest, Pa.
double bulk_modulus(const scene::Steel& steel);
/// Steel that never yields.
void make_elastic(scene::Scene& scene);

/// Weak and smooth from the first instant, with its peak (Pa) at `peak_time` (s), and done after ten times
/// that.
scene::Load pulse(double peak, double peak_time);

/// Runs to `end` (s) in equal steps no longer than the stable one at rest; returns the step (s).
double run_to(mpm::Simulation& simulation, double end);

/// Speed (m/s) towards the nose of a pulse between two times (s) at which it is whole and inside: of the
/// centre of its momentum. Runs to `end`.
double speed_of_pulse(mpm::Simulation& simulation, double begin, double end);

/// Axial Cauchy stress of a steel or charge particle, tension positive, Pa.
double axial_stress(const mpm::Body<materials::Steel>& body, std::size_t slot);
double axial_stress(const mpm::Body<materials::Charge>& body, std::size_t slot);

/// Lowest and highest temperature of all particles, K; whether all are finite.
struct TemperatureRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool finite = true;
};
TemperatureRange range_of(const mpm::Simulation& simulation);

/// Time step (s) of a Fourier number dt k/(rho c h^2) of the charge in cells of `cell` (m).
double step_of_fourier_number(const scene::Charge& charge, double cell, double fourier_number);

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

/// Observed order of convergence from two errors and the ratio of their mesh sizes (> 1).
double observed_order(double coarse_error, double fine_error, double ratio);

}  // namespace launchsafe::verify::mechanics
