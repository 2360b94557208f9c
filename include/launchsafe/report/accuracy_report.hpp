// An accuracy study as tables, pages, JSON, a picture, and the record for other studies.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/accuracy.hpp"

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
/// One screen: how wrong is the critical gap, why believe it, what would it cost to halve the error.
std::string summary(const study::AccuracyResult& result);

/// The whole report, with what is printed on a terminal and every file.
Report report_of(const study::AccuracyResult& result);

}  // namespace launchsafe::report
