// The heated skin of the charge after the launch, when neither air nor friction heats it: does it run away?
// dT/dt = (k/(rho c)) d2T/dx2 + (Q Z/c) exp(-(E/R)/T) over the depth x, at first with one temperature for
// x < h, the skin, and another below, the charge. The surface x = 0 is insulated: any air would cool it more.
#pragma once

#include "launchsafe/surface/skin.hpp"

namespace launchsafe::surface {

/// How finely a skin is followed. With the defaults a runaway temperature is off by 0.2 K at most for the
/// kinetics of Composition B, and times by 3 % from 0.5 K above it on; over all kinetics that explode within
/// 1 ms to 10 s at 420 to 700 K it is at most 0.8 K too high.
struct SkinResolution {
  int nodes = 6;           ///< in the skin; the more, the slower their spacing grows below it
  double tolerance = 0.1;  ///< K, error of one step in time
};

/// State of a skin when following it ended. All three are NaN where an input is not a number.
struct AfterLaunch {
  double time = 0;                      ///< s after the launch
  double temperature = 0;               ///< K, of the surface
  std::optional<double> ignition_time;  ///< s after the launch; none where it did not ignite
};

/// Follows a skin from the temperatures (K) of skin and charge at the end of a launch. It ends when the skin
/// ignites, at T1, or at T2 where T1 is not below it; when it has lost half of its excess over the charge; or
/// at the time `until` (s). A skin no hotter than the charge never cools.
AfterLaunch follow_after_launch(const SkinModel& model, double skin, double charge, double until = 3600.0,
                                SkinResolution resolution = {});

/// Seconds from the end of a history that ended without ignition to the ignition of its hottest station, of
/// those that tile the bottom, on a charge of a temperature (K). Nothing where that station cools, or where
/// the history ignited before; NaN where an input is not a number. A skin that is hotter at the end ignites
/// sooner, so that the other stations need not be followed.
std::optional<double> ignition_after_launch(const SkinModel& model, const SkinHistory& history,
                                            const trace::BottomTrace& trace, double charge);

/// Lowest temperature (K, to 0.01 K) of a skin at the end of a launch from which it ignites later on, or at
/// once, on a charge of a temperature (K). NaN where an input is not a number. Hotter skins ignite too, so
/// that this one number decides for all gaps of a launch.
double runaway_temperature(const SkinModel& model, double charge, SkinResolution resolution = {});
}  // namespace launchsafe::surface
