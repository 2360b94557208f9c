// Watches a running simulation: energy balance, extremes, and whether it can still be believed.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/run/case_result.hpp"

#include <optional>
#include <string>
#include <string_view>

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

}  // namespace launchsafe::run
