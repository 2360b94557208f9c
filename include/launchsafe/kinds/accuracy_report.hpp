// An accuracy study as tables, pages, JSON, a picture, and the record for other studies.
#pragma once

#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/report.hpp"

#include <string>

namespace launchsafe::kinds {

/// The answer in a few lines: how wrong the scene's own setting is, what the cheapest good settings are.
std::string answer(const AccuracyResult& result);

/// A row for every compared quantity: its values on the reference meshes, order, limit and uncertainty.
report::Table reference_table(const AccuracyResult& result);
/// A row for every setting: cost and errors.
report::Table setting_table(const AccuracyResult& result);
/// A row for every setting: error of the temperature at Study::times; without rows where there are none.
report::Table time_table(const AccuracyResult& result);

/// A row for every station: T max on the reference meshes, order, limit, uncertainty.
report::Table point_table(const AccuracyResult& result);

/// Error of T max against processor time, with the front of the settings that no other one beats.
report::Plot error_plot(const AccuracyResult& result);
/// One screen: how wrong is the critical gap, why believe it, what would it cost to halve the error.
std::string summary(const AccuracyResult& result);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const AccuracyResult& result);

}  // namespace launchsafe::kinds
