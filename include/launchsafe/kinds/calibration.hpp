// The study of kind calibration: the constants that published rows ask for, and what follows for the others.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/study/calibration_record.hpp"

namespace launchsafe::kinds {

/// The constants of the surface that are calibrated.
struct SurfaceConstants {
  double localisation = study::not_a_number;          ///< of friction heat, > 0
  double exchange_time = study::not_a_number;         ///< of the air's heat, s, > 0
  double ignition_temperature = study::not_a_number;  ///< T1, K
};

/// The mechanical run of one mesh; its failure is also why a run
/// that completed is no evidence.
struct CalibrationRun : study::FinishedRun {
  study::StudyCase input;
  explicit CalibrationRun(const study::StudyCase& of) : input(of) { outcome = study::RunOutcome::ran; }
  const run::MechanicsResult& mechanics() const { return result.mechanics; }
};

/// What a study file of this kind says besides.
struct CalibrationSettings {
  std::vector<double> meshes;  ///< m, cell sizes; empty: the scene's
  bool load_fitted = false;    ///< the bell of the load is fitted to the calibrated rows too
  std::string frozen_at;       ///< where rule and weights were settled before the fit, for people
};

/// Puts constants into a scene or a model of its skin.
void put(const SurfaceConstants& constants, scene::Surface& surface, materials::KineticsParameters& kinetics);

/// The rows that constants are fitted to: nothing else is.
struct CalibrationTargets {
  study::Reference zero_gap;  ///< above all sets the localisation
  study::Reference wide_gap;  ///< above all sets the exchange time
  double safe_gap = 0;        ///< m, largest gap that did not ignite
  double igniting_gap = 0;    ///< m, smallest gap that did
  /// Fitted are not only the two highest temperatures, which two constants meet exactly, but all that
  /// `weighted_misfits` knows of the two rows, by least squares.
  bool load_fitted = false;
  double early_time = 10e-3;  ///< s
};

/// Constants with how well they meet the rows they were fitted to.
struct CalibratedConstants {
  SurfaceConstants constants;
  /// K, maximum temperatures without a trigger at the safe and the igniting gap: T1 is between them
  double ignition_lowest = study::not_a_number, ignition_highest = study::not_a_number;
  std::string failure;  ///< why there are none; empty when all went well
};

/// Fits localisation, exchange time and ignition temperature on one trace with the model's friction closure
/// and kinetics. Root finding by TOMS 748; the two fits are repeated until the highest temperatures of both
/// rows are met. Where the load is fitted, least squares start from there.
CalibratedConstants calibrate(const surface::SkinModel& model, const trace::BottomTrace& trace,
                              const CalibrationTargets& targets);

/// The bell that was fitted to the calibrated rows together with localisation and exchange time, by least
/// squares, and how well the rows determine the five.
struct FittedLoad {
  std::optional<scene::Load> bell;              ///< none where the fit failed
  std::size_t numbers = 0;                      ///< that were fitted to
  double sum_of_squares = study::not_a_number;  ///< of what is left of them, each over its weight
  double condition = study::not_a_number;  ///< of the Jacobian with respect to the logarithms of the five
  /// Of the logarithms of study::fitted_keys, row by row. The weights count as standard deviations, and
  /// larger ones where the fit leaves more than them.
  std::vector<double> covariance;
  std::size_t runs = 0;  ///< mechanical runs that it took
  std::string failure;   ///< why there is none; empty when all went well
};

/// A published number beside the computed one.
struct ComparedNumber {
  std::string quantity = {};               ///< "T max", "T at 10 ms", "spread at 10 ms", "ignition time", ...
  double gap = 0;                          ///< m
  double computed = study::not_a_number;   ///< K or s
  double published = study::not_a_number;  ///< K or s
  bool temperature = true;                 ///< counts in the root mean square; spreads and times do not
  bool in_seconds = false;
  bool selects = false;  ///< counts among the misfits by which a model is chosen
  study::Use use = study::Use::held_out;
  double misfit() const { return computed - published; }
};

/// What was found on one mesh.
struct CalibrationRow {
  double cell_size = 0;  ///< m
  scene::FrictionClosure closure = scene::FrictionClosure::total_strain_rate;
  CalibratedConstants calibrated;
  std::vector<ComparedNumber> compared;
  std::vector<double> selection;                  ///< K, misfits by which a model is chosen among others
  double root_mean_square = study::not_a_number;  ///< K, over the temperatures that are not fitted
  double selection_root_mean_square = study::not_a_number;  ///< K, over `selection`; NaN without any
  std::string failure;  ///< of the run or of the fit; empty when all went well
};

/// Misfits of temperatures (K) that nothing was fitted to, as evidence of how far others may be off.
struct MisfitBound {
  int count = 0;
  double root_mean_square = study::not_a_number;  ///< infinite where one of them is not known
  double factor = study::not_a_number;            ///< Student's for so many, 95 % one-sided
  double bound() const { return factor * root_mean_square; }
};
MisfitBound misfit_bound(const CalibrationRow& row);

struct CalibrationResult : StudyResult {
  std::vector<CalibrationRun> runs;
  std::optional<FittedLoad> load;              ///< where the study asks for one; all runs are under it
  study::StationConvergence stations;          ///< around the recommended row
  std::vector<CalibrationRow> rows;            ///< mesh by mesh
  std::optional<std::size_t> recommended_row;  ///< on the mesh of the scene
  std::string reason;                          ///< what the evidence says
  SurfaceConstants in_scene;                   ///< what the scene file holds now
  /// The recommended row; nullptr without one.
  const CalibrationRow* recommended() const { return recommended_row ? &rows[*recommended_row] : nullptr; }
};

/// Runs a study of kind calibration: one mechanical run a mesh, some more to fit the load, everything else on
/// the traces.
CalibrationResult run_calibration(const study::StudyFile& study, const study::StudyOptions& options = {});

/// Nothing of a calibration that was interrupted.
std::optional<study::CalibrationRecord> record_of(const CalibrationResult& result);

/// What the evidence supports, and which constants the scene should hold.
std::string answer(const CalibrationResult& result);
report::Report report_of(const CalibrationResult& result);

/// The recommended constants beside those of the scene file.
report::Table constants_table(const CalibrationResult& result);

}  // namespace launchsafe::kinds
