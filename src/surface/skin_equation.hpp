// The skin equation of one station with constant rates over one interval, and its integrator.
#pragma once

#include "launchsafe/surface/skin.hpp"

#include <span>
#include <vector>

namespace launchsafe::surface::detail {

/// dT/dt = exchange_rate (air + air_slope t - T) + heating + (Q Z/c)(1 - lambda) exp(-(E/R)/T), t from the
/// begin of the interval.
struct SkinEquation {
  double exchange_rate = 0;  ///< 1/s
  double air = 0;            ///< K, at t = 0
  double air_slope = 0;      ///< K/s
  double heating = 0;        ///< K/s, friction
};

/// Ignition temperatures of one set of kinetics.
struct Trigger {
  double temperature = 0;  ///< K, where the solid stops being inert: T1, or T2 where T1 is not below it
  double amplification =
      1;  ///< between T1 and T2 all heating counts this often: 1/(1 - gain), gain = Q/(c (T2 - T1))
  bool immediate = true;  ///< gain >= 1: one release of heat feeds the next, up to T2 at once
};
Trigger trigger_of(const SkinModel& model);

/// Share of Arrhenius heat in all that heats a solid at temperature T, 0 to 1. `outside` in K/s.
double chemical_share(const SkinModel& model, double temperature, double outside);

/// Heat of reaction where something outside carried a solid within h (s) from the temperature `before` (K)
/// past the trigger. It did so at `outside` K/s; `time` (s) is that of the begin.
void release(const SkinModel& model, const Trigger& trigger, SkinPoint& point, double before, double outside,
             double time, double h);

/// The point after dt >= 0 (s). A point or an equation that is not finite gives NaN and no ignition.
SkinPoint advance(const SkinModel& model, const SkinEquation& equation, SkinPoint point, double dt);

/// Likewise of many points, which `heating` (K/s) heats each: as many at once as a register holds, where one
/// step follows a solid; the others one by one.
void advance(const SkinModel& model, const SkinEquation& equation, std::span<const double> heating,
             std::vector<SkinPoint>& points, double dt);

}  // namespace launchsafe::surface::detail
