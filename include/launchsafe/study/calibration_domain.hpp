// Where the constants that scenes start from were calibrated, and what of a scene lies outside of that.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/study/record_domain.hpp"

#include <memory>

namespace launchsafe::study {

/// The published rows that localisation and exchange time were fitted to, and how well the launch with these
/// constants meets what nothing was fitted to. As of reports/calibrate_table8.
struct CalibrationEvidence {
  double friction_rise = 116.1;  ///< K, of T max without a gap above the initial temperature: localisation
  double air_rise = 51.6;        ///< K, that 0.02 cm of air add: exchange time
  double largest_gap = 4e-4;     ///< m, of the rows
  /// K, of T max by the constants on this launch; taken where no fit uncertainty is stated. Half the distance
  /// between the temperatures that T1 separates, or the bound of the misfits of what nothing was fitted to,
  /// whichever is larger.
  double fit_uncertainty = 2.86;
};

struct FiringEvidence;  // firing_posterior.hpp

/// A launch with its calibrated constants: they hold where they were found.
struct Calibration {
  scene::Scene scene;
  CalibrationEvidence evidence;
  std::shared_ptr<const FiringEvidence> firings = {};  ///< none of a calibration on published results
};

/// m, the largest gap of a round that was fired without ignition at no lower a peak pressure and no colder
/// than the scene's, and thinner than any that ignited at no higher a pressure and no hotter; below 0 where
/// there was none. Without firings the largest gap of the published rows.
double calibrated_gap(const Calibration& calibration, const scene::Scene& scene);

/// The launch that the constants of scene::Scene were calibrated on: the 155 mm shell of the paper.
scene::Scene calibration_scene();
/// That launch with its evidence: what holds where a study names no record of another calibration.
Calibration shipped_calibration();

/// What of a scene lies outside of a calibration. On firings it holds within the pressures and temperatures
/// that were fired, and nothing carries it beyond.
RecordDistance distance_to_calibration(const scene::Scene& scene, const Calibration& calibration);

}  // namespace launchsafe::study
