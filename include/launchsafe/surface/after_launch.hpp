// The heated skin of the charge after the launch, when neither air nor friction heats it: does it run away?
// dT/dt = (k/(rho c)) d2T/dx2 + (Q Z/c) exp(-(E/R)/T) over the depth x, at first with one temperature for
// x < h, the skin, and another below, the charge. The surface x = 0 is insulated: any air would cool it more.
#pragma once

#include "launchsafe/surface/skin.hpp"

namespace launchsafe::surface {

/// How finely a skin is followed. With the defaults a runaway temperature is off by 0.1 K at most, and times
/// by 3 % from 0.5 K above it on.
struct SkinResolution {
  int nodes = 6;           ///< in the skin; the more, the slower their spacing grows below it
  double tolerance = 0.1;  ///< K, error of one step in time
};

/// A skin when it was followed no further; all are NaN where an input is not a number.
struct AfterLaunch {
  double time = 0;                      ///< s after the launch
  double temperature = 0;               ///< K, of the surface
  std::optional<double> ignition_time;  ///< s after the launch; none where it did not ignite
};

/// Follows a skin that had a temperature (K) at the end of a launch, as the charge had, up to a time (s) or
/// until it ignites, at T1, or at T2 where T1 is not below it; or cools: loses half of what it was hotter.
AfterLaunch follow_after_launch(const SkinModel& model, double skin, double charge, double until = 3600.0,
                                SkinResolution resolution = {});

/// Lowest temperature (K, to 0.01 K) of a skin at the end of a launch from which it ignites later on, or at
/// once, on a charge of a temperature (K). NaN where an input is not a number.
double runaway_temperature(const SkinModel& model, double charge, SkinResolution resolution = {});
}  // namespace launchsafe::surface
