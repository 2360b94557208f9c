#include "launchsafe/scene/selective_inertia.hpp"

#include "launchsafe/scene/plan.hpp"

#include <algorithm>
#include <vector>

namespace launchsafe::scene {

LargestChanges largest_changes(const Load& load, double window) {
  const PressureHistory history(load);
  std::vector<double> times = history.marks();
  times.push_back(history.peak_time());
  const double end = end_time(load), between = std::max(window / 8.0, end * 1e-6);
  for (double time = 0.0; time < end; time += between) times.push_back(time);
  LargestChanges changes;
  for (const double time : times) {
    const double earlier = time > window ? history.at(time - window) : 0.0, here = history.at(time),
                 later = history.at(std::min(end, time + window));
    changes.rise = std::max({changes.rise, here - earlier, later - here});
    changes.fall = std::max({changes.fall, earlier - here, here - later});
  }
  return changes;
}

double transit_time(const Scene& scene) {
  const Extent charge = charge_extent(scene);
  return std::max(charge.x_end - charge.x_begin, charge.r_end) /
         longitudinal_speed(materials::Law(scene.charge()));
}

/// A load that rises faster rings a shell whose inertia is selective. On the 155 mm shell with steps four
/// times as long T max changes by 1.1 K or less with pulses of a half, a quarter and an eighth of the
/// published width (from 10 to 90 % of the peak in 0.6 ms), and with a thirtieth it ignites or does not.
bool changes_too_fast_for_selective_inertia(const Scene& scene) {
  constexpr double shortest = 0.5e-3, transits = 2.5, share = 0.8;
  const double window = std::max(shortest, transits * transit_time(scene));
  const LargestChanges changes = largest_changes(scene.load, window);
  return std::max(changes.rise, changes.fall) > share * PressureHistory(scene.load).peak();
}

double usual_selective_inertia(const Scene& scene) {
  constexpr double measured = 4.0, measured_where_a_gap_closes = 2.0;
  const Numerics& numerics = scene.numerics;
  const bool is_possible =
      numerics.formulation == Formulation::total_lagrangian && scene.frame == Frame::co_moving;
  const bool was_measured = has_charge(scene) && scene.coupling == Coupling::one_way &&
                            scene.load.curve_time.empty() && !(numerics.inertial_scaling > 1.0) &&
                            !changes_too_fast_for_selective_inertia(scene);
  if (!is_possible || !was_measured) return 1.0;
  return scene.surface.model == GapModel::closing ? measured_where_a_gap_closes : measured;
}

}  // namespace launchsafe::scene
