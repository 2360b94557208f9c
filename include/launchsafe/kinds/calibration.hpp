// The study of kind calibration: the constants that published temperatures ask for, as a constants file.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/scene/constants.hpp"

namespace launchsafe::kinds {

/// Everything that a study file of this kind says besides the keys of all kinds.
struct CalibrationSettings {
  /// Keys that are found by least squares: of a scene, or of what holds a face of the charge, as
  /// scene::Constants names it.
  std::string fit = "load.peak_time, load.width, load.steepness, friction.localisation, gap.exchange_time";
  double temperature_weight = 0.5;             ///< K, standard deviation of a published temperature
  double spread_weight = 2, place_weight = 2;  ///< K, of spreads, and of what a published place is colder
  std::string file = "constants.toml";         ///< name of the constants file
  /// Intervals in which the constants hold, by the names of scene::range_keys, as people write them; empty
  /// where the study states none.
  std::map<std::string, std::string> range = [] {
    std::map<std::string, std::string> intervals;
    for (const scene::RangeKey& each : scene::range_keys()) intervals[each.name];
    return intervals;
  }();
};

/// A key that is fitted.
struct FittedKey {
  std::string name;                   ///< as the study has it: "interface.side.friction"
  scene::KeyDescription description;  ///< of the scene's key: "interface.wall.friction"
  double start = 0;                   ///< SI, > 0, the value in the study's scene
};

/// Constants, or why there are none.
struct CalibrationResult : StudyResult {
  std::vector<FittedKey> fitted;
  math::NonlinearFit fit;  ///< unknowns: logarithms of the fitted values over their starts
  std::optional<scene::Constants> constants;
  std::string failure;     ///< why there are none, a clause; empty where there are
  std::string label;       ///< of `run`; empty where none was made
  study::FinishedRun run;  ///< with the fitted values, or the one that failed
};

/// Runs a study of kind calibration: fits the keys to the published rows by least squares, a launch for every
/// new set of values that the mechanics knows; puts the ignition temperature between the largest gap that did
/// not ignite and the smallest that did; and compares the launch with what is published.
CalibrationResult run_calibration(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The constants in one line, or why there are none.
std::string answer(const CalibrationResult& result);
report::Report report_of(const CalibrationResult& result);

}  // namespace launchsafe::kinds
