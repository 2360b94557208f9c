#include "launchsafe/study/calibration_record.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/record_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

constexpr const char* calibration_format = "launchsafe calibration record 2";

ordered_json calibration_content(const CalibrationRecord& record) {
  const CalibrationEvidence& evidence = record.calibration.evidence;
  return {{"format", calibration_format},
          {"title", record.title},
          {"model_version", record.model_version},
          {"failure", record.failure},
          {"scene", scene::to_toml(record.calibration.scene)},
          {"load_fitted", record.load_fitted},
          {"references_sha256", record.references_digest},
          {"friction_rise_K", evidence.friction_rise},
          {"air_rise_K", evidence.air_rise},
          {"largest_gap_m", evidence.largest_gap},
          {"largest_misfit_K", evidence.largest_misfit},
          {"held_out_misfit_K", record.held_out_misfit},
          {"ignition_lowest_K", record.ignition_lowest},
          {"ignition_highest_K", record.ignition_highest},
          {"selection_rms_K", record.selection_root_mean_square},
          {"station_change_to_finer_K", record.stations.finer},
          {"station_change_from_coarser_K", record.stations.coarser}};
}

void read_numbers(const ordered_json& object, RecordReader& reader, CalibrationRecord& record) {
  using scene::above_to, scene::between;
  const auto number = [&](const char* key, const scene::Limits& limits) {
    return reader.number(object[key], key, limits);
  };
  const auto maybe = [&](const char* key) {
    return reader.number_or_none(object[key], key, between(0, 1e4));
  };
  CalibrationEvidence& evidence = record.calibration.evidence;
  evidence.friction_rise = number("friction_rise_K", above_to(0, 5000));
  evidence.air_rise = number("air_rise_K", above_to(0, 5000));
  evidence.largest_gap = number("largest_gap_m", above_to(0, 0.01));
  evidence.largest_misfit = number("largest_misfit_K", between(0, 5000));
  record.held_out_misfit = number("held_out_misfit_K", between(0, 5000));
  record.ignition_lowest = number("ignition_lowest_K", above_to(0, 5000));
  record.ignition_highest = number("ignition_highest_K", above_to(record.ignition_lowest, 5000));
  record.selection_root_mean_square = maybe("selection_rms_K");
  record.stations = {maybe("station_change_to_finer_K"), maybe("station_change_from_coarser_K")};
}

void read_calibrated_scene(const ordered_json& object, RecordReader& reader, CalibrationRecord& record) {
  const std::string text = reader.text(object["scene"], "scene");
  if (reader.fault()) return;
  auto read = scene::parse_scene(text, "scene of the record");
  if (!read) {
    reader.refuse("scene", "a scene that cannot be read: " + read.error().message(), "the calibrated scene");
    return;
  }
  record.calibration.scene = std::move(read->scene);
}

CalibrationRecord calibration_from(const ordered_json& object, RecordReader& reader) {
  CalibrationRecord record;
  std::vector<std::string> keys{"digest"};
  const ordered_json content = calibration_content(record);
  for (const auto& [key, value] : content.items()) keys.push_back(key);
  if (!reader.has_keys(object, "", keys)) return record;
  record.title = reader.text(object["title"], "title");
  record.model_version = reader.whole(object["model_version"], "model_version", 1, 1'000'000);
  if (!reader.fault() && record.model_version != run::model_version) {
    reader.refuse(
        "model_version", fmt::format("{}", record.model_version),
        fmt::format("{}, the version of this program; make the calibration anew", run::model_version));
  }
  record.failure = reader.text(object["failure"], "failure");
  if (record.failure.empty()) {
    read_numbers(object, reader, record);
  } else {
    record.calibration.evidence = no_evidence;
  }
  read_calibrated_scene(object, reader, record);
  record.load_fitted = reader.flag(object["load_fitted"], "load_fitted");
  record.references_digest = reader.text(object["references_sha256"], "references_sha256");
  return record;
}

}  // namespace

bool StationConvergence::converges() const {
  constexpr double most = 3.0, small = 1.0;  // K
  return finer <= most && (finer <= coarser || finer < small);
}

std::string to_json_text(const CalibrationRecord& record) { return record_text(calibration_content(record)); }

scene::Expected<CalibrationRecord> parse_calibration_record(const std::string& text,
                                                            const std::string& file) {
  RecordReader reader(file);
  const auto object =
      reader.parse(text, calibration_format, "calibration.json", "a study of kind calibration");
  if (!object) return *reader.fault();
  CalibrationRecord record = calibration_from(*object, reader);
  if (!reader.fault()) reader.check_digest(*object, calibration_content(record));
  if (reader.fault()) return *reader.fault();
  return record;
}

double fit_uncertainty_of(const CalibrationRecord& record) {
  return std::max(0.5 * (record.ignition_highest - record.ignition_lowest), record.held_out_misfit);
}

}  // namespace launchsafe::study
