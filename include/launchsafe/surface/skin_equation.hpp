// The skin equation of one station with constant rates over one interval, and its integrator.
#pragma once

#include "launchsafe/surface/skin.hpp"

#include <span>

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
  /// Between T1 and T2 all heating counts this often: 1/(1 - gain), gain = Q/(c (T2 - T1)).
  double amplification = 1;
  bool immediate = true;  ///< gain >= 1: one release of heat feeds the next, up to T2 at once
};
Trigger trigger_of(const SkinModel& model);

/// The point after dt >= 0 (s). A point or an equation that is not finite gives NaN and no ignition.
SkinPoint advance(const SkinModel& model, const SkinEquation& equation, SkinPoint point, double dt);

/// Likewise of many points, which `heating` (K/s) heats each: as many at once as a register holds, where one
/// step follows a solid; the others one by one.
void advance(const SkinModel& model, const SkinEquation& equation, std::span<const double> heating,
             std::vector<SkinPoint>& points, double dt);

// A bottom trace read as one set of constant rates per interval between samples.

/// Pressure on the air over one interval, Pa: its ends and its mean.
struct IntervalPressure {
  double begin = 0, end = 0, mean = 0;
};

/// Air temperature over one interval as a straight line, K.
struct LinearAir {
  double begin = 0, end = 0;
};

/// The straight line whose mean is that of the adiabat over the interval, to fourth order in its length, and
/// whose slope is that of the two ends. The skin takes in the integral of the air temperature, so matching
/// means makes the trace's sampling error fourth order where linear interpolation of the samples would leave
/// second order, and a thinned trace, which keeps the means exactly, gives nearly the same skin. The line may
/// jump at samples; it never falls below the initial air temperature.
LinearAir linear_air(const materials::AirParameters& air, const IntervalPressure& pressure);

/// Reads a trace, which must outlive it, for one model and one gap (m). Interval k ends at sample k + 1.
class Intervals {
 public:
  Intervals(SkinModel model, const trace::BottomTrace& trace, double gap);
  Intervals(SkinModel model, const trace::BottomTrace&& trace, double gap) = delete;

  std::size_t count() const { return trace_.samples() > 0 ? trace_.samples() - 1 : 0; }
  double length(std::size_t interval) const { return trace_.time[interval + 1] - trace_.time[interval]; }
  IntervalPressure pressure(std::size_t interval) const;
  double pressure_at(std::size_t sample) const { return pressure_[sample]; }
  /// Rate (1/s) at which the skin takes on the air's temperature.
  double exchange_rate() const { return exchange_rate_; }
  /// Friction heating (K/s) of a station, the traced energy spread evenly over the interval; NaN where the
  /// trace holds no energies for the closure asked for.
  double friction_heating(std::size_t interval, std::size_t station) const;

 private:
  SkinModel model_;
  const trace::BottomTrace& trace_;
  const std::vector<double>& pressure_;
  const std::vector<double>& mean_;
  const std::vector<double>* friction_;  ///< nothing for the closure `none`
  double exchange_rate_;                 ///< 1/s
};

}  // namespace launchsafe::surface::detail
