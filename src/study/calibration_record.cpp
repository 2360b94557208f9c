#include "launchsafe/study/calibration_record.hpp"

#include "launchsafe/study/firing_record.hpp"
#include "launchsafe/study/record_reader.hpp"

namespace launchsafe::study {
namespace {

constexpr RecordFormat calibration_format{"launchsafe calibration record 3",
                                          "calibration.json",
                                          "a study of kind calibration",
                                          {"digest", "format"}};

/// What a calibration without a failure has.
void describe_numbers(RecordObject& object, CalibrationRecord& record) {
  using scene::above_to, scene::between;
  const OrNone temperature_or_none{between(0, 1e4)};
  CalibrationEvidence& evidence = record.calibration.evidence;
  object.value("friction_rise_K", evidence.friction_rise, above_to(0, 5000));
  object.value("air_rise_K", evidence.air_rise, above_to(0, 5000));
  object.value("largest_gap_m", evidence.largest_gap, above_to(0, 0.01));
  object.value("misfits", record.misfits, 0, 1000);
  object.value("misfit_bound_K", record.misfit_bound, temperature_or_none);
  object.value("fit_uncertainty_K", evidence.fit_uncertainty, between(0, 1e4));
  constexpr std::size_t entries = fitted_keys.size() * fitted_keys.size();
  const std::size_t expected = record.load_fitted ? entries : 0;
  object.value("covariance_of_logarithms", record.covariance, between(-1e4, 1e4), expected, expected);
  object.value("ignition_lowest_K", record.ignition_lowest, above_to(0, 5000));
  object.value("ignition_highest_K", record.ignition_highest, above_to(record.ignition_lowest, 5000));
  object.value("selection_rms_K", record.selection_root_mean_square, temperature_or_none);
  object.value("station_change_to_finer_K", record.stations.finer, temperature_or_none);
  object.value("station_change_from_coarser_K", record.stations.coarser, temperature_or_none);
}

void describe_calibration(RecordObject& object, CalibrationRecord& record) {
  object.value("title", record.title);
  object.model_version(record.model_version, "make the calibration anew");
  object.value("failure", record.failure);
  object.scene(record.calibration.scene, "the calibrated scene");
  object.value("load_fitted", record.load_fitted);
  object.value("references_sha256", record.references_digest);
  if (object.reading() && !record.failure.empty())
    record.calibration.evidence = no_evidence;
  else
    describe_numbers(object, record);
}

}  // namespace

bool StationConvergence::converges() const {
  constexpr double most = 3.0, small = 1.0;  // K
  return finer <= most && (finer <= coarser || finer < small);
}

std::string to_json_text(const CalibrationRecord& record) {
  return record_text(content_by(calibration_format, describe_calibration, record));
}

scene::Expected<CalibrationRecord> parse_calibration_record(const std::string& text,
                                                            const std::string& file) {
  if (is_firing_record(text))
    return scene::error_at({file}, "format", "the record of a calibration on firings",
                           "the record of a calibration on published results");
  return parse_record<CalibrationRecord>(text, file, calibration_format, describe_calibration);
}

}  // namespace launchsafe::study
