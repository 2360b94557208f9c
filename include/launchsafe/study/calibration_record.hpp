// What a calibration found on published results, kept for the studies that use its constants.
#pragma once

#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {

/// Largest change of the end temperature of any station without a gap, with the constants of one mesh, to a
/// finer mesh and from a coarser one.
struct StationConvergence {
  double finer = not_a_number;    ///< K
  double coarser = not_a_number;  ///< K
  /// At most 3 K to the finer mesh, and no more than from the coarser one or below 1 K.
  bool converges() const;
};

/// The calibrated launch, how well it meets what is published, and whether its stations converge; or why
/// there is no calibration.
struct CalibrationRecord {
  std::string title;         ///< of the calibration
  std::string failure = {};  ///< why no constants meet the rows, and nothing below means anything; else empty
  Calibration calibration;
  bool load_fitted = false;               ///< the shape of the load is calibrated too, not only the constants
  double ignition_lowest = not_a_number;  ///< K, T max without a trigger at the largest gap that is safe
  double ignition_highest = not_a_number;  ///< K, and at the smallest that ignites: T1 is in the middle
  /// K, below which 95 % of the misfits of temperatures lie, by so many that nothing was fitted to: Student's
  /// factor for their number times their root mean square. NaN without any.
  double misfit_bound = not_a_number;
  int misfits = 0;
  /// Of the logarithms of `fitted_keys`, row by row; empty where the load was not fitted.
  std::vector<double> covariance = {};
  double selection_root_mean_square = not_a_number;  ///< K; NaN where no row was used for selection
  StationConvergence stations = {};                  ///< K; NaN where not measured
};

/// What a calibration with its load fits by least squares, in the order of its covariance.
inline constexpr std::array fitted_keys{"load.peak_time", "load.width", "load.steepness",
                                        "friction.localisation", "gap.exchange_time"};

/// Of a calibration that found no constants.
inline constexpr CalibrationEvidence no_evidence{not_a_number, not_a_number, not_a_number, not_a_number};

/// The record as a file.
std::string to_json_text(const CalibrationRecord& record);
/// Refuses a record of another model version, and a scene that no reader takes. `file` is named in errors.
scene::Expected<CalibrationRecord> parse_calibration_record(const std::string& text, const std::string& file);

/// Reads the record that a study names, if it names one, gives its load and constants to the scene, and notes
/// them among the overrides. A fit uncertainty that the study does not state becomes the record's.
void use_calibration(StudyFile& study, const std::filesystem::path& folder);

/// Reads the record of other models that a study names, if it names one.
void read_model_form(StudyFile& study, const std::filesystem::path& folder);

}  // namespace launchsafe::study
