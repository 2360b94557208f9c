// A calibration as tables, a page and JSON.
#pragma once

#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/store/result.hpp"

#include <string>

namespace launchsafe::kinds {

/// What the evidence supports, and which constants the scene should hold.
std::string answer(const CalibrationResult& result);

/// Constants and what they miss, of every mesh, closure and kinetics: what is printed on stdout.
report::Table calibration_table(const CalibrationResult& result);
/// Every hold-out of one row: predicted, published, and their difference.
report::Table hold_out_table(const CalibrationResult& result, const CalibrationRow& row);
/// The differences of the recommended row from published results by which a model is chosen among others; no
/// rows without any.
report::Table selection_table(const CalibrationResult& result);
/// What the constants do from mesh to mesh.
report::Table convergence_table(const CalibrationResult& result);
/// The recommended constants beside those of the scene file.
report::Table constants_table(const CalibrationResult& result);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const CalibrationResult& result);

}  // namespace launchsafe::kinds
