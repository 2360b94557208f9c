#include "launchsafe/study/gap_share.hpp"

#include <array>
#include <cmath>

namespace launchsafe::study {

const ShareTraits& traits_of(ShareKind kind) {
  using enum ShareClass;
  static const std::array<ShareTraits, share_kinds> traits{{
      {"peak_pressure", "peak pressure", random, "a measured spread of the peak pressure"},
      {"pulse_length", "length of the pulse", random, "measured curves of several rounds"},
      {"initial_temperature", "initial temperature", random, "a narrower range of temperatures"},
      {"muzzle_exit", "time of the muzzle exit", random, "a measured time of the exit"},
      {"stated_inputs", "inputs, as stated", random, "a better known launch"},
      {"load_curve", "noise and smoothing of the measured curve", knowledge, "a gauge with less noise"},
      {"computation", "computation", knowledge, "a finer setting, or a record of its accuracy"},
      {"sliding", "sliding at the base", knowledge, "a base that holds the charge"},
      {"fit", "calibrated constants", knowledge, "more measured temperatures to calibrate on"},
      {"model_form", "other models", knowledge, "measurements of how the shell holds the charge"},
      {"accepted", "accepted constants, which the calibration has otherwise", knowledge,
       "a calibration with these constants"},
  }};
  return traits.at(static_cast<std::size_t>(kind));
}

std::string to_string(ShareClass of_class) { return of_class == ShareClass::random ? "random" : "knowledge"; }

namespace {

/// All moves in one direction as one, m.
template <class Move>
double combined(const std::vector<GapShare>& shares, Move move) {
  double squares = 0.0, sum = 0.0;
  for (const GapShare& share : shares) {
    const double distance = move(share);
    if (traits_of(share.kind).of_class == ShareClass::random)
      squares += distance * distance;
    else
      sum += distance;
  }
  return std::sqrt(squares) + sum;
}

/// A length that is not negative; NaN stays NaN.
double not_negative(double length) { return length < 0.0 ? 0.0 : length; }

}  // namespace

double move_towards_ignition(double safe, const GapShare& share) {
  return share.raised == no_ignition ? 0.0 : not_negative(safe - share.raised);
}

GapBounds bounds_of(double safe, double igniting, const std::vector<GapShare>& shares) {
  const double down =
      combined(shares, [&](const GapShare& share) { return move_towards_ignition(safe, share); });
  const double up =
      combined(shares, [&](const GapShare& share) { return not_negative(share.lowered - igniting); });
  return {not_negative(safe - down), igniting + up};
}

}  // namespace launchsafe::study
