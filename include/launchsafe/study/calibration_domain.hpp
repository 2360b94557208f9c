// Where the constants that scenes start from were calibrated, and what of a scene lies outside of that.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// The published rows that localisation and exchange time of scene::Scene were fitted to, and how well the
/// launch with these constants predicts the rows that nothing was fitted to (reports/calibrate_table8).
struct CalibrationEvidence {
  double friction_rise = 116.1;  ///< K, of T max without a gap above the initial temperature: localisation
  double air_rise = 51.6;        ///< K, that 0.02 cm of air add: exchange time
  double largest_gap = 4e-4;     ///< m, of the rows
  /// K, the largest misfit of a held-out temperature: 10 ms, no gap. Taken where no fit uncertainty is
  /// stated.
  double largest_misfit = 20.93;
};

/// The launch that the constants were calibrated on: the 155 mm shell of the paper.
scene::Scene calibration_scene();

/// How a scene differs from `calibration_scene`.
struct CalibrationDistance {
  /// Differences that nothing carries the constants over, for people: "another shell", "charge.density".
  std::vector<std::string> unknown;
  /// Differences over which the relative errors of the constants are carried, for people: "peak pressure".
  std::vector<std::string> carried;
  bool other_load_shape = false;  ///< among `carried`
  bool other_numerics = false;    ///< among `carried`: the constants hold the mesh error of their own grid
  bool inside() const { return unknown.empty() && carried.empty(); }
};
CalibrationDistance distance_to_calibration(const scene::Scene& scene);

}  // namespace launchsafe::study
