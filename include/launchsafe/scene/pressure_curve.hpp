// Measured chamber pressure from a CSV file: two columns under a header that names the units; and from what a
// pressure gauge recorded to a curve that a scene takes: its offset, the start of the launch, its noise.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <filesystem>

namespace launchsafe::scene {

/// Pa; no load may be larger, whether it comes from a file or stands in a scene.
inline constexpr double largest_load = 10e9;
/// s; two points of a curve are further apart. No gauge is faster, and slopes stay finite.
inline constexpr double least_curve_interval = 1e-12;
/// s; times of a curve lie within this of 0, so that impulses stay finite.
inline constexpr double largest_curve_time = 1e6;

struct PressureCurve {
  std::vector<double> time;      ///< s, increasing, up to `largest_curve_time` on either side of 0
  std::vector<double> pressure;  ///< Pa, 0 to `largest_load`
};

/// Reads at least two points under a header such as "time_ms,pressure_MPa", "Time (ms);Pressure (bar)" or
/// "t [s]<tab>p [psi]". Columns may stand in either order. What separates them in the header, a semicolon, a
/// tab or else a comma, separates them everywhere. Cells may be in quotation marks. Between semicolons or
/// tabs, or in quotation marks, numbers may have decimal commas, then all of them. Lines that start with #
/// are left out; lines end with LF, CRLF or CR; a byte-order mark of UTF-8 is passed over. At most
/// `largest_curve` bytes.
Expected<PressureCurve> read_pressure_curve(const std::filesystem::path& file);

/// The same from text; `file` is only named in errors.
Expected<PressureCurve> parse_pressure_curve(const std::string& text, const std::string& file);

/// Like `parse_pressure_curve`, of a record as a gauge writes it: further columns are left out, and pressures
/// may be negative, down to -`largest_load`. `column`: name of the pressure's column in the header without
/// its unit; empty: the only one that is a pressure.
Expected<PressureCurve> parse_gauge_record(const std::string& text, const std::string& file,
                                           const std::string& column);

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
