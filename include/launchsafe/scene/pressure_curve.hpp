// Measured chamber pressure from a CSV file: two columns under a header that names the units.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::scene {

/// Pa; no load may be larger, whether it comes from a file or stands in a scene.
inline constexpr double largest_load = 10e9;

struct PressureCurve {
  std::vector<double> time;      ///< s, increasing
  std::vector<double> pressure;  ///< Pa, 0 to `largest_load`
};

/// Reads at least two points under a header such as "time_ms,pressure_MPa" or "time (ms), pressure (MPa)".
/// Columns may stand in either order and be separated by commas, semicolons or tabs; lines that start with #
/// are left out.
Expected<PressureCurve> read_pressure_curve(const std::filesystem::path& file);

/// The same from text; `file` is only named in errors.
Expected<PressureCurve> parse_pressure_curve(const std::string& text, const std::string& file);

}  // namespace launchsafe::scene
