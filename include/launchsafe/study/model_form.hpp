// How the critical gap changes with the choice of the model, each calibrated on the same rows, and which part
// of that counts as uncertainty of a verdict.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/bracket.hpp"
#include "launchsafe/study/record_domain.hpp"

namespace launchsafe::study {

struct CalibrationRecord;

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

/// What a model needs to stand in a record.
struct ModelFormEntry {
  std::string name, title;
  const CalibrationRecord* calibration = nullptr;
  scene::Scene scene;                    ///< of the model
  std::vector<GapOrBound> critical_gap;  ///< m, for every pressure
};
/// Of models at the same peak pressures (Pa, increasing), the default first. Errors (a text): a default
/// without constants; a scene that is not of its calibration; an alternative that is the default itself, or a
/// model of another launch or of other published rows; stations that were compared with no finer mesh.
scene::Expected<ModelFormRecord, std::string> make_model_form(const std::vector<ModelFormEntry>& entries,
                                                              std::vector<double> peak_pressures);

std::string to_json_text(const ModelFormRecord& record);
/// Refuses an edited record and one of another model version. `file` is named in errors.
scene::Expected<ModelFormRecord> parse_model_form(const std::string& text, const std::string& file);

/// The peak pressures (Pa) from the lowest to the highest at which models were compared: those of a record,
/// or of the one that ships (reports/model_form).
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
