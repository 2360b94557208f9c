// How one scene differs from another, and what of that a record of the other one does not speak of; where the
// constants that scenes start from were calibrated; and what the choice of the model does.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/bracket.hpp"

namespace launchsafe::study {

/// One input that two scenes have otherwise.
struct Difference {
  /// Under its full name: "load.peak", "material.second.yield_stress"; scene::foreign_shell for bodies at
  /// other places or of other laws, scene::foreign_interfaces for faces that hold each other otherwise,
  /// "observation_point" for these.
  scene::KeyDescription key;
  scene::Value value, recorded;
  bool of_material = false;  ///< a number of a material
};

/// Everything that a scene has otherwise than a recorded one: keys; bodies by place and law, and every number
/// of the material of each; interfaces by the bodies that they hold; observation points. Numbers are compared
/// up to the round-off of units. Names of bodies and materials are the user's and make no difference.
std::vector<Difference> differences(const scene::Scene& scene, const scene::Scene& recorded);

enum class RecordKind { calibration, accuracy, model_form };

/// How far a scene lies outside of a record.
struct RecordDistance {
  /// What nothing carries the record over, each with what the scene says of it: keys of the scene, and
  /// scene::foreign_shell, foreign_material (where several numbers differ), foreign_interfaces.
  std::vector<scene::Implausible> foreign;
  /// Differences over which relative errors are carried, for people: "peak pressure".
  std::vector<std::string> carried;
  bool other_load_shape = false;  ///< among `carried`
  bool other_numerics = false;    ///< among `carried`: the constants hold the mesh error of their own grid
  bool inside() const { return foreign.empty() && carried.empty(); }
  /// The names of both, those that are foreign first.
  std::vector<std::string> names() const;
};
RecordDistance distance_to_record(RecordKind record, const scene::Scene& scene, const scene::Scene& recorded);

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

/// A launch with its calibrated constants: they hold where they were found.
struct Calibration {
  scene::Scene scene;
  CalibrationEvidence evidence;
};

/// The launch that the constants of scene::Scene were calibrated on: the 155 mm shell of the paper.
scene::Scene calibration_scene();
/// That launch with its evidence: what holds where a study names no record of another calibration.
Calibration shipped_calibration();

// --- how the critical gap changes with the choice of the model, each calibrated on the same rows, and which
// part of that counts as uncertainty of a verdict ---

/// A model beside the default one.
struct ModelAlternative {
  std::string name, title;
  std::string not_counted;               ///< why it enters no share, a clause; empty where it counts
  std::vector<GapOrBound> critical_gap;  ///< m, for every pressure of the record
};

/// The default model and its alternatives.
struct ModelFormRecord {
  scene::Scene scene;                    ///< the default's, with its constants
  std::vector<double> peak_pressures;    ///< Pa, increasing
  std::vector<GapOrBound> critical_gap;  ///< m, of the default
  std::vector<ModelAlternative> alternatives;
};

std::string to_json_text(const ModelFormRecord& record);
/// Refuses a record of another model version. `file` is named in errors.
scene::Expected<ModelFormRecord> parse_model_form(const std::string& text, const std::string& file);

/// The peak pressures (Pa) from the lowest to the highest at which models were compared: those of a record,
/// or of the one that ships (studies/models).
scene::Limits compared_pressures(const std::optional<ModelFormRecord>& record);

/// The recorded pressures around a peak: their indices, equal where it is one of them.
struct PressureInterval {
  std::size_t below = 0, above = 0;
};

/// How far the alternatives that count move the critical gap from the default's.
struct ModelFormShift {
  double gap = 0;      ///< m, >= 0, by which the smallest one is below: towards ignition; NaN where not known
  double later = 0;    ///< m, >= 0, by which the largest one is above; infinite where one never ignites
  std::string reason;  ///< why it is not known, a clause
  /// Around the launch's peak; nothing where the record is of another launch.
  std::optional<PressureInterval> around = {};
};
/// Of a launch of the record's scene at a peak pressure among the recorded ones; between two of them, which
/// must be within 15 % of each other, the larger shift of both. Not known where the scene differs in anything
/// else than its gaps, numerics and output, where no alternative counts, and where the default has a bound
/// instead of a critical gap.
ModelFormShift model_form_shift(const ModelFormRecord& record, const scene::Scene& scene);

/// The titles of alternatives that could change what a gap (m) does, between the recorded pressures around
/// its launch: under which one that ignites would not, or might not; or, apart from those that count, one
/// that does not ignite might.
std::vector<std::string> models_that_differ(const ModelFormRecord& record, const PressureInterval& around,
                                            double gap, bool ignites);

}  // namespace launchsafe::study
