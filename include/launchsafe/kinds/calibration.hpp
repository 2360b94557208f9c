// The study of kind calibration: the constants that published rows ask for, and what they then predict.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/scene/load_shape.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"
#include "launchsafe/surface/skin.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// What a study file of this kind says besides.
struct CalibrationSettings {
  std::vector<double> meshes;     ///< m, cell sizes; empty: the scene's
  bool compare_kinetics = false;  ///< calibrate with every named kinetics, not only the scene's
  double ignition_lowest = study::not_a_number;   ///< K, published bracket of the ignition temperature
  double ignition_highest = study::not_a_number;  ///< K
  /// s, two instants between which the published temperature without a gap rises fast; empty: the scene's
  /// load
  std::vector<double> fast_rise;
};

/// The calibrated constants of a scene.
struct Constants {
  double localisation = study::not_a_number;
  double exchange_time = study::not_a_number;         ///< s
  double ignition_temperature = study::not_a_number;  ///< K
  /// Puts them into a scene or a model of its skin.
  void put_into(scene::Surface& surface, materials::KineticsParameters& kinetics) const;
};

/// The gaps and temperatures that constants are fitted to (model section 8): nothing else is.
struct CalibrationTargets {
  study::Reference zero_gap;  ///< sets the localisation
  study::Reference wide_gap;  ///< sets the exchange time
  double safe_gap = 0;        ///< m, largest gap that did not ignite
  double igniting_gap = 0;    ///< m, smallest gap that did
};
/// The targets among a study's references, or what is missing.
scene::Expected<CalibrationTargets> calibration_targets(const study::StudyFile& study);

/// Constants with how well they meet the rows they were fitted to.
struct CalibratedConstants {
  Constants constants;
  double zero_gap_misfit = study::not_a_number;  ///< K, left over
  double wide_gap_misfit = study::not_a_number;  ///< K, left over
  /// K, maximum temperatures without a trigger at the safe and the igniting gap: T1 is between them
  double ignition_lowest = study::not_a_number, ignition_highest = study::not_a_number;
  std::string failure;  ///< why there are none; empty when all went well
};

/// Fits localisation, exchange time and ignition temperature on one trace with the model's friction closure
/// and kinetics. Root finding by TOMS 748; the two fits are repeated until both rows are met.
CalibratedConstants calibrate(const surface::SkinModel& model, const trace::BottomTrace& trace,
                              const CalibrationTargets& targets);

/// The analytic load that was fitted to what is published of the rise without a gap.
struct FittedLoad {
  double peak_time = study::not_a_number;     ///< s
  double exponent = study::not_a_number;      ///< with which the fast rise lasts as long as published
  scene::TurningTimes turning;                ///< s, of this load
  double early_misfit = study::not_a_number;  ///< K, left over at Study::early_time
  std::string failure;                        ///< why there is none; empty when all went well
};

/// A prediction beside a published number.
struct HoldOut {
  std::string quantity = {};               ///< "T max", "T at 10 ms", "spread at 10 ms", "ignition time", ...
  double gap = 0;                          ///< m
  double predicted = study::not_a_number;  ///< K or s
  double published = study::not_a_number;  ///< K or s
  bool temperature = true;                 ///< counts in the root mean square; spreads and times do not
  bool in_seconds = false;
  study::Use use = study::Use::held_out;
  double misfit() const { return predicted - published; }
};

/// Where the maximum was predicted and published.
struct Placement {
  std::string quantity;
  double gap = 0;  ///< m
  std::string predicted, published;
};

/// One of the misfits by which a model is chosen among others (studies/model_form/README.md).
struct SelectionMisfit {
  std::string quantity;
  double misfit = study::not_a_number;  ///< K, predicted minus published
};

/// One mesh with one friction closure and one kinetics.
struct CalibrationRow {
  double cell_size = 0;  ///< m
  scene::FrictionClosure closure = scene::FrictionClosure::total_strain_rate;
  std::string kinetics;
  bool calibratable = true;  ///< false for the closure "none": predictions with the scene's constants
  CalibratedConstants calibrated;
  std::vector<HoldOut> hold_outs;
  std::vector<Placement> placements;
  std::vector<SelectionMisfit> selection;
  double root_mean_square = study::not_a_number;            ///< K, over the temperatures that are held out
  double selection_root_mean_square = study::not_a_number;  ///< K, over `selection`; NaN without any
  double spread_root_mean_square = study::not_a_number;     ///< K, over the spreads
  std::string failure;  ///< of the run or of the fit; empty when all went well
};

/// Fills the hold-outs, the placements and the root mean squares of a row: what its constants predict for the
/// rows that nothing was fitted to.
void predict(const study::Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
             CalibrationRow& row);

/// How much a constant moves from the coarsest to the finest mesh.
struct Convergence {
  scene::FrictionClosure closure = scene::FrictionClosure::total_strain_rate;
  std::string kinetics;
  double localisation_change = study::not_a_number;  ///< (finest - coarsest)/finest
  double exchange_time_change = study::not_a_number;
};

/// The mechanical run of one mesh.
struct CalibrationRun {
  study::StudyCase input;
  run::MechanicsResult mechanics;
  study::RunOutcome outcome = study::RunOutcome::ran;
  std::string failure;  ///< why there are no mechanics to calibrate on; empty where there are
};

/// What the evidence says.
struct Recommendation {
  std::optional<std::size_t> row;  ///< of `rows`: closure that predicts best, on the mesh of the scene
  std::string reason;
};

struct CalibrationResult {
  study::StudyFile study;
  std::vector<CalibrationRun> runs;
  std::optional<FittedLoad> load;      ///< where the study asks for one; all runs are under it
  study::StationConvergence stations;  ///< around the recommended row
  std::vector<CalibrationRow> rows;    ///< mesh by mesh, closure by closure, kinetics by kinetics
  std::vector<Convergence> convergence;
  Recommendation recommendation;
  Constants in_scene;  ///< what the scene file holds now
  study::Timing timing;
  bool interrupted = false;
  /// The recommended row; nullptr without one.
  const CalibrationRow* recommended() const {
    return recommendation.row ? &rows[*recommendation.row] : nullptr;
  }
};

/// Runs a study of kind calibration: one mechanical run a mesh, some more to fit the load, everything else on
/// the traces.
CalibrationResult run_calibration(const study::StudyFile& study, const study::StudyOptions& options = {});

/// Nothing of a calibration that was interrupted.
std::optional<study::CalibrationRecord> record_of(const CalibrationResult& result);

/// The row of the table of kinds.
Kind calibration_kind();

/// What the evidence supports, and which constants the scene should hold.
std::string answer(const CalibrationResult& result);

/// The recommended constants beside those of the scene file.
report::Table constants_table(const CalibrationResult& result);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const CalibrationResult& result);

}  // namespace launchsafe::kinds
