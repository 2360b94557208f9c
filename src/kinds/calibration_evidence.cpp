// The record of a calibration: what its result says of the launch that it was made on.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::kinds {

namespace {

std::string digest_of(const std::vector<study::Reference>& references) {
  std::string text;
  for (const study::Reference& row : references) {
    text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", row.gap, row.maximum_temperature, row.point,
                        row.early_temperature, row.early_point, row.spread, row.early_spread,
                        row.ignition_time, row.rise_begins, row.rise_ends, row.calibrated, row.selection);
  }
  return store::sha256(text);
}

/// The scene of the recommended row, with its constants.
scene::Scene calibrated_scene(const CalibrationResult& result, const CalibrationRow& row) {
  const auto run = std::ranges::find_if(
      result.runs, [&](const auto& each) { return each.input.cell_size == row.cell_size; });
  scene::Scene scene = run->input.scene.scene;
  scene.surface.friction = row.closure;
  row.calibrated.constants.put_into(scene.surface, scene.charge().kinetics);
  scene.accepted.clear();
  return scene;
}

}  // namespace

std::optional<study::CalibrationRecord> record_of(const CalibrationResult& result) {
  const auto targets = calibration_targets(result.study);
  if (!targets || result.interrupted) return std::nullopt;
  study::CalibrationRecord record;
  record.title = result.study.study.title;
  record.model_version = run::model_version;
  record.load_fitted = result.load.has_value();
  record.references_digest = digest_of(result.study.study.references);
  if (!result.recommendation.row) {
    record.failure = result.recommendation.reason;
    record.calibration = {result.study.scene.scene, study::no_evidence};
    return record;
  }
  const CalibrationRow& row = *result.recommended();
  record.calibration.scene = calibrated_scene(result, row);
  study::CalibrationEvidence& evidence = record.calibration.evidence;
  evidence.friction_rise =
      targets->zero_gap.maximum_temperature - record.calibration.scene.initial_temperature;
  evidence.air_rise = targets->wide_gap.maximum_temperature - targets->zero_gap.maximum_temperature;
  evidence.largest_gap = targets->igniting_gap;
  const MisfitBound misfits = misfit_bound(row);
  record.misfits = misfits.count;
  record.misfit_bound = misfits.bound();
  if (result.load) record.covariance = result.load->covariance;
  record.ignition_lowest = row.calibrated.ignition_lowest;
  record.ignition_highest = row.calibrated.ignition_highest;
  const double half = 0.5 * (record.ignition_highest - record.ignition_lowest);
  // Without a misfit that tells, that of the shipped calibration stays.
  evidence.fit_uncertainty =
      std::max(half, misfits.count > 0 ? misfits.bound() : study::CalibrationEvidence{}.fit_uncertainty);
  record.selection_root_mean_square = row.selection_root_mean_square;
  record.stations = result.stations;
  return record;
}

}  // namespace launchsafe::kinds
