// Fields at one instant.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/run/case_result.hpp"

#include <vector>

namespace launchsafe::run {

/// Fields of all particles, where the stations' part of the charge's bottom is, and the faces that can slide.
Snapshot take_snapshot(const mpm::Simulation& simulation, const std::vector<trace::Station>& stations);

/// Adds the skin of a gap, as it was on the trace: linear between its samples but where a station ignites,
/// which is a jump. There it is that of the sample before, and of the first station from its ignition on that
/// of the sample after. `ignition_temperature` in K.
void add_skin(Snapshot& shot, const GapResult& gap, const trace::BottomTrace& trace,
              double ignition_temperature);

/// Whether any body's plastic strain is above 0.
bool has_yielded(const mpm::Simulation& simulation);
/// Whether any crack is longer than at first by more than a thousandth.
bool has_grown_crack(const mpm::Simulation& simulation);
/// m, of the nodes of all faces whose bond has not held.
double largest_slip(const mpm::Simulation& simulation);

}  // namespace launchsafe::run
