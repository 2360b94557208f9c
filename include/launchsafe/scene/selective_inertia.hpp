// Which launches take longer steps, with more inertia where a cell needs it, and how fast a load changes.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

/// Largest pressures (Pa) by which a load rises and falls within a time window (s); before 0 it is none.
/// Sampled eight times a window, at its peak, and where a measured curve bends, so that less than an eighth
/// of a window is missed on the way up.
struct LargestChanges {
  double rise = 0.0, fall = 0.0;
};
LargestChanges largest_changes(const Load& load, double window);

/// Time (s) that sound takes through the charge, along its longest side.
double transit_time(const Scene& scene);

/// Whether the load changes too fast for selective inertia: by more than 80 % of its peak within 0.5 ms, or
/// the time that sound takes 2.5 times through a longer charge. What it does to temperatures was measured for
/// slower loads.
bool changes_too_fast_for_selective_inertia(const Scene& scene);

/// The `numerics.selective_inertia` of a launch that states none: 4, a quarter of the steps, where that was
/// measured against true inertia (reports/accuracy), else 1. Where its gap closes it is 2: T max is then that
/// of true inertia within 0.3 K where the charge is free from the start and within 2 % of its rise where it
/// rings, and 4 lowers it by 3 K. A measured curve has true inertia: more of it moves the shell's own
/// frequencies, and a ring of 1.5 % at 2.4 kHz that ignites the 155 mm shell without a gap leaves it at 416 K
/// with 4.
double usual_selective_inertia(const Scene& scene);

}  // namespace launchsafe::scene
