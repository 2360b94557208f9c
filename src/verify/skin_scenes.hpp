// Skin models and bottom traces that the checks and stress tests of the surface share.
#pragma once

#include "launchsafe/surface/skin.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <functional>
#include <vector>

namespace launchsafe::verify {

/// A skin without reaction and friction that exchanges heat with the air in the time constant `exchange_time`
/// (s).
surface::SkinModel inert_skin(double exchange_time);
/// The same under a film of air.
surface::SkinModel inert_film();

/// Pressure (Pa) at the end of an interval, and its mean over it.
struct PressureSample {
  double end, mean;
};
/// Of an interval between two times (s); for the first sample both are 0.
using PressureOfInterval = std::function<PressureSample(double begin, double end)>;
using FunctionOfTime = std::function<double(double)>;

/// A pressure (Pa) of time (s) whose integral from 0 (Pa s) is known.
PressureOfInterval with_integral(FunctionOfTime pressure, FunctionOfTime integral);

/// A bottom without friction under a pressure, over `duration` (s) in equal intervals.
trace::BottomTrace pressed_bottom(std::vector<trace::Station> stations, int intervals, double duration,
                                  const PressureOfInterval& pressure);

}  // namespace launchsafe::verify
