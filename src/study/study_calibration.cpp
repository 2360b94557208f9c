#include "launchsafe/study/study_calibration.hpp"

#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/firing_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace launchsafe::study {
namespace {

constexpr std::array constants{"friction.localisation", "gap.exchange_time", "kinetics.ignition_temperature"};
constexpr std::array load_shape{"load.shape", "load.peak_time", "load.width", "load.steepness"};

bool states(const StudyFile& study, const std::string& key) {
  return study.scene.given.contains(key) || study.overrides.contains(key);
}

/// Whether the scene and the study leave the shape of the load to the calibration: one that they state stays,
/// and the constants are carried to it as to any other.
bool takes_load(const StudyFile& study, const CalibrationRecord& record) {
  return record.load_fitted && record.calibration.scene.load.curve_time.empty() &&
         study.scene.scene.load.curve_time.empty() &&
         std::none_of(load_shape.begin(), load_shape.end(),
                      [&](const char* key) { return states(study, key); });
}

/// The first constant to which the study's scene gives another value than the record.
Fault contradicted_constant(const StudyFile& study, const scene::Scene& calibrated) {
  constexpr double digits = 1e-3;  // scenes round what a calibration found
  for (const std::string name : constants) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    const scene::Value record = key.get(calibrated), own = key.get(study.scene.scene);
    if (study.overrides.contains(name)) {
      return fault_at(study, "calibration", "a calibration beside [set] " + name,
                      "either a calibration or its constants in [set]");
    }
    const double wanted = std::get<double>(record), found = std::get<double>(own);
    if (!study.scene.given.contains(name) || std::abs(found - wanted) <= digits * std::abs(wanted)) continue;
    return fault_at(
        study, "calibration",
        fmt::format("{} {} in the scene and {} in the record", name, scene::format_value(key, own),
                    scene::format_value(key, record)),
        "constants from one of both: leave " + name + " out of the scene, or name no calibration");
  }
  return std::nullopt;
}

/// A constant's uncertainty may be stated larger than its record shows, not smaller.
Fault settle_fit_uncertainty(StudyFile& study, const CalibrationRecord& record) {
  const double shown = record.calibration.evidence.fit_uncertainty;
  double& stated = study.study.fit_uncertainty;
  if (std::isnan(stated)) stated = shown;
  if (stated >= shown) return std::nullopt;
  return fault_at(study, "fit_uncertainty.value",
                  fmt::format("{:.3g} K, and {:.3g} K in the record of the calibration", stated, shown),
                  "no less than the record shows, or no fit_uncertainty, which takes it");
}

/// The record of a calibration of either sort. On firings none fits the load.
scene::Expected<CalibrationRecord> parse_either(const std::string& text, const std::string& file) {
  if (!is_firing_record(text)) return parse_calibration_record(text, file);
  auto record = parse_firing_record(text, file);
  if (!record) return record.error();
  CalibrationRecord own;
  own.title = std::move(record->title);
  own.model_version = record->model_version;
  own.calibration = std::move(record->calibration);
  return own;
}

/// The record that a key names, noted as one that the study rests on.
template <class Record>
scene::Expected<Record> read_named(StudyFile& study, const std::filesystem::path& folder, const char* key,
                                   const std::string& name, const std::string& wanted,
                                   scene::Expected<Record> (*parse)(const std::string&, const std::string&)) {
  const auto text = read_named_file(study, folder, key, name, wanted);
  if (!text) return text.error();
  study.records.push_back(store::sha256(*text));
  return parse(*text, (folder / name).string());
}

}  // namespace

Fault use_calibration(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.calibration_record;
  if (name.empty()) return std::nullopt;
  const auto record =
      read_named(study, folder, "calibration", name, "the calibration.json of a calibration", parse_either);
  if (!record) return record.error();
  if (record->calibration.firings && !study.study.kind.gives_verdicts)
    return fault_at(study, "calibration",
                    "a calibration on firings, of whose constants a study of this kind would take one value",
                    "the record of a calibration on published results");
  if (!record->failure.empty()) {
    return fault_at(study, "calibration", "a record without constants: " + record->failure,
                    "the record of a calibration that meets its rows");
  }
  if (Fault fault = contradicted_constant(study, record->calibration.scene)) return fault;
  std::vector<std::string> keys(constants.begin(), constants.end());
  if (takes_load(study, *record)) keys.insert(keys.end(), load_shape.begin(), load_shape.end());
  std::vector<Change> changes;
  for (const std::string& key : keys) {
    const auto& known = *scene::find_key(scene::scene_keys(), key);
    const scene::Value value = known.get(record->calibration.scene);
    study.overrides[key] = scene::format_value(known, value);
    changes.push_back({key, value, study.overrides[key], "calibration", place_of_key(study, "calibration")});
  }
  auto changed = with_changes(study.scene, changes);
  if (!changed) return changed.error();
  study.scene = std::move(*changed);
  study.study.calibration = record->calibration;
  const auto& firings = study.study.calibration.firings;
  study.study.demonstration |= firings && firings->demonstration;
  return settle_fit_uncertainty(study, *record);
}

Fault read_model_form(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.model_form_record;
  if (name.empty()) return std::nullopt;
  if (std::isfinite(study.study.model_form_uncertainty)) {
    return fault_at(study, "model_form_uncertainty.value",
                    "a stated uncertainty beside a record of other models",
                    "either model_form_uncertainty or model_form");
  }
  auto record = read_named(study, folder, "model_form", name,
                           "the model_form.json of a comparison of calibrated models", parse_model_form);
  if (!record) return record.error();
  study.study.model_form = std::move(*record);
  return std::nullopt;
}

}  // namespace launchsafe::study
