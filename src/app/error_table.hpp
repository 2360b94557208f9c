// The table of error against processor time of `launchsafe verify --error-against-time`: text, JSON and
// files.
#pragma once

#include "launchsafe/report/drawing_limits.hpp"
#include "launchsafe/report/written_files.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/verify/error_against_time.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::app {

/// A series and what it gave.
struct MeasuredSeries {
  verify::ErrorSeries series;
  std::vector<verify::MeasuredSetting> settings;
};

/// For a terminal; `command` is the one that makes it.
std::string error_table_text(const std::vector<MeasuredSeries>& measured, const std::string& command);

nlohmann::ordered_json error_table_json(const std::vector<MeasuredSeries>& measured,
                                        const std::string& command);

inline const std::vector<std::string> error_table_files{"parts.csv", "parts.md", "parts.svg"};
/// Writes these files, parts.svg only where gnuplot is installed.
store::Result<report::WrittenFiles> write_error_table(const std::vector<MeasuredSeries>& measured,
                                                      const std::string& command,
                                                      const std::filesystem::path& folder,
                                                      const report::DrawingLimits& limits);

}  // namespace launchsafe::app
