// What the report of a calibration says of the fitted load, of how well the rows determine it, and of the
// misfits.
#pragma once

#include "launchsafe/kinds/calibration.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::kinds {

/// What the calibrated rows determine: the five, their standard deviations and correlations. No rows where no
/// load was fitted.
report::Table fitted_table(const CalibrationResult& result);
std::vector<report::Column> fitted_columns();

/// What was settled before, condition of the fit, and what a sixth unknown would do. Empty likewise.
std::string fit_text(const CalibrationResult& result);

/// The bound of the misfits, and what it rests on. Empty without any.
std::string misfits_text(const CalibrationResult& result);

nlohmann::ordered_json load_json(const CalibrationResult& result);

}  // namespace launchsafe::kinds
