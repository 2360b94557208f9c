// Measured chamber pressure from a CSV file: two columns under a header that names the units.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace launchsafe::scene
