#include "launchsafe/study/calibration_record.hpp"

#include "launchsafe/study/record_reader.hpp"

namespace launchsafe::study {
namespace {

constexpr RecordFormat calibration_format{"launchsafe calibration record 3", "calibration.json",
                                          "a study of kind calibration"};

void describe_calibration(RecordObject& object, CalibrationRecord& record) {
  object.value("title", record.title);
  object.model_version("make the calibration anew");
  object.value("failure", record.failure);
  object.scene(record.calibration.scene, "the calibrated scene");
  object.value("load_fitted", record.load_fitted);
  CalibrationEvidence& evidence = record.calibration.evidence;
  if (object.reading() && !record.failure.empty()) {
    evidence = no_evidence;
    return;
  }
  object.value("friction_rise_K", evidence.friction_rise);
  object.value("air_rise_K", evidence.air_rise);
  object.value("largest_gap_m", evidence.largest_gap);
  object.value("misfits", record.misfits);
  object.value("misfit_bound_K", record.misfit_bound);
  object.value("fit_uncertainty_K", evidence.fit_uncertainty);
  object.value("covariance_of_logarithms", record.covariance);
  object.value("ignition_lowest_K", record.ignition_lowest);
  object.value("ignition_highest_K", record.ignition_highest);
  object.value("selection_rms_K", record.selection_root_mean_square);
  object.value("station_change_to_finer_K", record.stations.finer);
  object.value("station_change_from_coarser_K", record.stations.coarser);
}

constexpr std::array constants{"friction.localisation", "gap.exchange_time", "kinetics.ignition_temperature"};
constexpr std::array load_shape{"load.shape", "load.peak_time", "load.width", "load.steepness"};

/// Whether the scene and the study leave the shape of the load to the calibration, which fitted one: one that
/// they state stays, and the constants are carried to it as to any other.
bool takes_load(const StudyFile& study, const CalibrationRecord& record) {
  const auto is_stated = [&](const char* key) {
    return study.scene.given.contains(key) || study.overrides.contains(key);
  };
  return record.load_fitted && record.calibration.scene.load.curve_time.empty() &&
         study.scene.scene.load.curve_time.empty() && std::ranges::none_of(load_shape, is_stated);
}

/// Refuses a constant to which the study's scene gives another value than the record.
void check_constants(const StudyFile& study, const scene::Scene& calibrated) {
  constexpr double digits = 1e-3;  // scenes round what a calibration found
  for (const std::string name : constants) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    const scene::Value record = key.get(calibrated), own = key.get(study.scene.scene);
    if (study.overrides.contains(name))
      refuse_at(study, "calibration", "a calibration beside [set] " + name,
                "either a calibration or its constants in [set]");
    const double wanted = std::get<double>(record), found = std::get<double>(own);
    if (!study.scene.given.contains(name) || std::abs(found - wanted) <= digits * std::abs(wanted)) continue;
    refuse_at(study, "calibration",
              fmt::format("{} {} in the scene and {} in the record", name, scene::format_value(key, own),
                          scene::format_value(key, record)),
              "constants from one of both: leave " + name + " out of the scene, or name no calibration");
  }
}

/// A constant's uncertainty may be stated larger than its record shows, not smaller.
void settle_fit_uncertainty(StudyFile& study, const CalibrationRecord& record) {
  const double shown = record.calibration.evidence.fit_uncertainty;
  double& stated = study.study.fit_uncertainty;
  if (std::isnan(stated)) stated = shown;
  if (!(stated >= shown))
    refuse_at(study, "fit_uncertainty.value",
              fmt::format("{:.3g} K, and {:.3g} K in the record of the calibration", stated, shown),
              "no less than the record shows, or no fit_uncertainty, which takes it");
}

}  // namespace

scene::Scene calibration_scene() {
  scene::Scene scene;
  scene.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  for (const char* body : {"nose", "wall"})
    scene.interfaces.push_back({.body = body, .condition = scene::Condition::sliding, .friction = 0.0});
  scene.load.muzzle_exit = 18e-3;  // where the published rows are read
  scene.numerics.cell_size = 1.25e-3;
  scene.numerics.growth_x = scene.numerics.growth_r = 1.3;
  scene.numerics.largest_cell = 20e-3;
  scene.numerics.time_step_factor = 0.65;
  scene.numerics.selective_inertia = 4.0;
  return scene;
}

Calibration shipped_calibration() { return {calibration_scene(), {}}; }

bool StationConvergence::converges() const {
  constexpr double most = 3.0, small = 1.0;  // K
  return finer <= most && (finer <= coarser || finer < small);
}

std::string to_json_text(const CalibrationRecord& record) {
  return record_text(calibration_format, describe_calibration, record);
}

scene::Expected<CalibrationRecord> parse_calibration_record(const std::string& text,
                                                            const std::string& file) {
  return parse_record<CalibrationRecord>(text, file, calibration_format, describe_calibration);
}

void use_calibration(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.calibration_record;
  if (name.empty()) return;
  const auto record = read_named_record(study, folder, "calibration", name,
                                        "the calibration.json of a calibration", parse_calibration_record);
  if (!record.failure.empty())
    refuse_at(study, "calibration", "a record without constants: " + record.failure,
              "the record of a calibration that meets its rows");
  check_constants(study, record.calibration.scene);
  std::vector<std::string> keys(constants.begin(), constants.end());
  if (takes_load(study, record)) keys.insert(keys.end(), load_shape.begin(), load_shape.end());
  Setting values;
  for (const std::string& key : keys) {
    const auto& known = *scene::find_key(scene::scene_keys(), key);
    values[key] = known.get(record.calibration.scene);
    study.overrides[key] = scene::format_value(known, values[key]);
  }
  set_keys(study, values, "calibration");
  study.study.calibration = record.calibration;
  settle_fit_uncertainty(study, record);
}

void read_model_form(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.model_form_record;
  if (name.empty()) return;
  if (std::isfinite(study.study.model_form_uncertainty))
    refuse_at(study, "model_form_uncertainty.value", "a stated uncertainty beside a record of other models",
              "either model_form_uncertainty or model_form");
  study.study.model_form = read_named_record(study, folder, "model_form", name,
                                             "the model_form.json of calibrated models", parse_model_form);
}

}  // namespace launchsafe::study
