// From what a pressure gauge recorded to a curve that a scene takes: its offset, the start of the launch, its
// noise.
#pragma once

#include "launchsafe/scene/pressure_curve.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace launchsafe::scene {

/// What the user says of a record; what is absent is found in it.
struct GaugeCleaning {
  std::optional<double> offset = {};   ///< Pa, that the gauge shows before the launch
  std::optional<double> trigger = {};  ///< Pa above the offset; where it is passed the launch begins
};

/// A cleaned curve, and what was done.
struct CleanedRecord {
  PressureCurve curve;            ///< its time is 0 where the launch begins
  double offset = 0.0;            ///< Pa, that was taken away
  double noise = 0.0;             ///< Pa, standard deviation of what is before the launch; 0 where unknown
  std::size_t quiet_points = 0;   ///< before the launch, that offset and noise are of
  double trigger = 0.0;           ///< Pa
  double start = 0.0;             ///< s, of the record, that is 0 now
  std::size_t points_before = 0;  ///< left out
  std::size_t points_below_zero = 0;   ///< noise about zero, set to 0
  double lowest = 0.0;                 ///< Pa, of these
  double peak = 0.0, peak_time = 0.0;  ///< Pa and s, of the curve
};

/// Takes the offset away, lets time begin at the trigger, and sets what noise left below zero to 0. All other
/// noise stays: what an average takes from a load counts as uncertainty where the scene averages
/// (load.smoothing), and would be stated nowhere if it were taken here.
///
/// The offset is the median of the points before the rise, which is where 2 % of the range is last passed
/// before the largest pressure; without at least ten such points it has to be given. The trigger is 1 % of
/// the peak, or five standard deviations of the noise where that is more. Errors, in the sense of the record:
/// no quiet points and no offset; an offset that differs from that of the quiet points by more than their
/// noise and a thousandth of the peak; a trigger that is never passed; a pressure further below zero than ten
/// standard deviations of the noise and 2 % of the peak, which is no noise.
Expected<CleanedRecord> clean(const PressureCurve& record, const GaugeCleaning& cleaning,
                              const std::string& file);

/// The curve as a CSV file that scenes take, with `remarks` (lines) above the header.
std::string csv_of(const PressureCurve& curve, const std::string& remarks);

}  // namespace launchsafe::scene
