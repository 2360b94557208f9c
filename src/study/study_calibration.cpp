#include "study_calibration.hpp"

#include "changed_scene.hpp"
#include "launchsafe/study/calibration_record.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::study::detail {
namespace {

/// The keys that a calibration settles. A measured curve of the study's scene stays.
std::vector<std::string> calibrated_keys(const scene::Scene& scene) {
  std::vector<std::string> keys{"friction.localisation", "gap.exchange_time",
                                "kinetics.ignition_temperature"};
  if (scene.load.curve_time.empty()) keys.insert(keys.end(), {"load.peak_time", "load.exponent"});
  return keys;
}

Fault unreadable(const StudyFile& study, const char* key, const std::string& name, const std::string& wanted,
                 const scene::InputError& error) {
  return fault_at(study, key, fmt::format("\"{}\", which cannot be read", name),
                  wanted + ", by its path from the study file's folder", error.suggestion);
}

}  // namespace

Fault use_calibration(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.calibration_record;
  if (name.empty()) return std::nullopt;
  const std::string file = (folder / name).string();
  const auto text = scene::read_text_file(file);
  if (!text)
    return unreadable(study, "calibration", name, "the calibration.json of a calibration", text.error());
  const auto record = parse_calibration_record(*text, file);
  if (!record) return record.error();
  if (!record->failure.empty()) {
    return fault_at(study, "calibration", "a record without constants: " + record->failure,
                    "the record of a calibration that meets its rows");
  }
  ChangedScene scene(study.scene);
  for (const std::string& key : calibrated_keys(study.scene.scene)) {
    if (study.overrides.contains(key)) {
      return fault_at(study, "calibration", fmt::format("a calibration beside [set] {}", key),
                      "either a calibration or its constants in [set]");
    }
    const auto& known = *scene::find_key(scene::scene_keys(), key);
    const scene::Value value = known.get(record->calibration.scene);
    study.overrides[key] = scene::format_value(known, value);
    scene.apply({key, value, study.overrides[key], "calibration", place_of_key(study, "calibration")});
  }
  if (!scene.complete()) return scene.error();
  study.scene = scene.take();
  study.study.calibration = record->calibration;
  if (!std::isfinite(study.study.fit_uncertainty)) study.study.fit_uncertainty = fit_uncertainty_of(*record);
  return std::nullopt;
}

Fault read_model_form(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.model_form_record;
  if (name.empty()) return std::nullopt;
  if (std::isfinite(study.study.model_form_uncertainty)) {
    return fault_at(study, "model_form_uncertainty", "a stated uncertainty beside a record of other models",
                    "either model_form_uncertainty or model_form");
  }
  const std::string file = (folder / name).string();
  const auto text = scene::read_text_file(file);
  if (!text)
    return unreadable(study, "model_form", name, "the model_form.json of the command model-form",
                      text.error());
  auto record = parse_model_form(*text, file);
  if (!record) return record.error();
  study.study.model_form = std::move(*record);
  return std::nullopt;
}

}  // namespace launchsafe::study::detail
