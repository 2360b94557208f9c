// A calibration as tables, a page and JSON.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/study/calibration.hpp"

#include <string>

namespace launchsafe::report {

/// What the evidence supports, and which constants the scene should hold.
std::string answer(const study::CalibrationResult& result);

/// Constants and what they miss, of every mesh, closure and kinetics: what is printed on stdout.
Table calibration_table(const study::CalibrationResult& result);
/// Every hold-out of one row: predicted, published, and their difference.
Table hold_out_table(const study::CalibrationResult& result, const study::CalibrationRow& row);
/// The differences of the recommended row from published results by which a model is chosen among others; no
/// rows without any.
Table selection_table(const study::CalibrationResult& result);
/// What the constants do from mesh to mesh.
Table convergence_table(const study::CalibrationResult& result);
/// The recommended constants beside those of the scene file.
Table constants_table(const study::CalibrationResult& result);

nlohmann::ordered_json to_json(const study::CalibrationResult& result);
std::string to_markdown(const study::CalibrationResult& result);

/// The whole report, with what is printed on a terminal and every file.
Report report_of(const study::CalibrationResult& result);

}  // namespace launchsafe::report
