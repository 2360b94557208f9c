// An accuracy study as tables, pages, JSON, a picture, and the record for other studies.
#pragma once

#include "launchsafe/report/drawing_limits.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/report/written_files.hpp"
#include "launchsafe/study/accuracy.hpp"

#include <filesystem>
#include <string>

namespace launchsafe::report {

/// The answer in a few lines: how wrong the scene's own setting is, what the cheapest good settings are.
std::string answer(const study::AccuracyResult& result);

/// A row for every compared quantity: its values on the reference meshes, order, limit and uncertainty.
Table reference_table(const study::AccuracyResult& result);
/// A row for every setting: cost and errors.
Table setting_table(const study::AccuracyResult& result);
/// A row for every setting: error of the temperature at Study::times; without rows where there are none.
Table time_table(const study::AccuracyResult& result);

/// A row for every station: T max on the reference meshes, order, limit, uncertainty.
Table point_table(const study::AccuracyResult& result);

nlohmann::ordered_json to_json(const study::AccuracyResult& result);
/// Error of T max against processor time, with the front of the settings that no other one beats.
Plot error_plot(const study::AccuracyResult& result);
/// The page; `picture` is the name of the picture's file, or empty where there is none.
std::string to_markdown(const study::AccuracyResult& result, const std::string& picture);
/// One screen: how wrong is the critical gap, why believe it, what would it cost to halve the error.
std::string summary(const study::AccuracyResult& result);

/// Writes accuracy.csv, reference.csv, points.csv, times.csv, error_against_time.svg, accuracy.json (the
/// record), summary.md, report.md and study.json into a folder, which is made. Errors: conflict,
/// write_failed.
store::Result<WrittenFiles> write_report(const study::AccuracyResult& result,
                                         const std::filesystem::path& folder,
                                         const DrawingLimits& limits = {});

}  // namespace launchsafe::report
