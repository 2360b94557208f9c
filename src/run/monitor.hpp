// Watches a running simulation: energy balance, extremes, whether it can still be believed, and how long a
// time step may be, from theory.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::run {

/// A state field of a body by name; null where its law has none of that name.
const math::AlignedArray* field_of(const mpm::AnyBody& any, std::string_view name);

/// The energy balance at the begin of the last step, in J of the whole shell (plane strain: per metre).
EnergyBalance energy_of(const mpm::Simulation& simulation);
MonitorSample monitor_sample(const mpm::Simulation& simulation, double time_step);
/// What became of the faces that can slide.
std::vector<InterfaceResult> interfaces_of(const mpm::Simulation& simulation);

LimiterCounts count_limited(const mpm::Simulation& simulation);

struct Stop {
  RunStatus status;
  std::string what;  ///< for people
};

/// Why the run has to stop now, if it has to. `largest_energy` is the largest energy scale seen so far (J):
/// drift is measured against it, so that the small energies of unloading do not magnify round-off.
std::optional<Stop> reason_to_stop(const mpm::Simulation& simulation, const EnergyBalance& energy,
                                   double largest_energy, double drift_limit);

/// The time step factor up to which a step is proved stable, wherever particles lie in their cells: the
/// smallest over the bodies of the scene.
///
/// Stresses and velocities are half a step apart (leapfrog), so a step is stable up to dt = 2/omega of the
/// fastest mode. A particle with shape functions S and gradients G holds at most the energy
/// V rho c^2 (sum G^2/S)(sum S u^2)/2 in nodal displacements u (Cauchy-Schwarz, both directions, c the
/// longitudinal speed), while its share of the nodal masses holds V rho omega^2 (sum S u^2)/2; hence
/// omega^2 <= c^2 (A_x + A_r), A = sum G^2/S along one direction (Irons and Treharne's theorem with particles
/// for elements).
/// For uGIMP with cell L and half-length l, A <= 2/(L l) + 1/(L (L - l)), reached as a particle leaves the
/// middle of a cell whose far node has no other particle: a free face. With one particle a cell (l = L/2)
/// that is 6/L^2, and on square cells the factor is 2/sqrt(12) = 0.577. A particle in the middle of its cell
/// has A = 4/L^2, as a finite element with one point has: c dt sqrt(1/dx^2 + 1/dr^2) <= 1, or 0.707. The hoop
/// strain adds to A_r about 1/r^2, which next to the axis is less than what the fixed node there takes away.
/// More particles a cell share their nodes, so the true limit is higher than this one. In the
/// total-Lagrangian form particles do not move in their cells: A = (1/S_0 + 1/S_1)/L^2 with the constant
/// weights S of a cell's two nodes, 4/L^2 for one particle a cell but for the row beside the axis, where the
/// weight with r makes it 4.5/L^2; the factor is 0.686. What holds hourglassing back is softer by far.
double proved_time_step_factor(const scene::Scene& scene);

/// "; the time step factor 0.8 is above 0.577, up to which ...": what a run that broke must say of its steps;
/// empty where they are proved stable.
std::string step_remark(const scene::Scene& scene);

}  // namespace launchsafe::run
