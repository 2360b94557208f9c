// What accepted constants of the surface do: the same skin with them as they are calibrated, on the same
// trace.
#pragma once

#include "launchsafe/study/calibration_domain.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// A skin with one constant as calibrated.
struct AsCalibrated {
  std::string key;         ///< the constant; empty: all of the gap and of friction together
  double temperature = 0;  ///< K, T max over the stations
  bool ignites = false;
};

/// The foreign constants that a skin can be evaluated anew with: all of the gap and of friction together,
/// where there are any, then each, then the ignition temperature.
std::vector<std::string> keys_as_calibrated(const CalibrationDistance& distance);

/// Whether constants of the gap or of friction are among them.
bool has_foreign_surface(const CalibrationDistance& distance);
/// The scene with all of these as calibrated, whatever else of it is foreign.
scene::Scene with_calibrated_surface(const scene::Scene& scene, const scene::Scene& calibrated,
                                     const CalibrationDistance& distance);

/// The skin of a gap (m) with each of these as calibrated.
std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const CalibrationDistance& distance, const trace::BottomTrace& trace,
                                        double gap);

/// K from there to ignition with all of the gap and of friction as calibrated; infinite where they are, minus
/// infinite where it ignites.
double margin_as_calibrated(const std::vector<AsCalibrated>& all, double ignition_temperature);

}  // namespace launchsafe::study
