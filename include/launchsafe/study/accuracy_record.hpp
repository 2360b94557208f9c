// What an accuracy study found out about settings, kept for the studies that use them.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// The scene keys that make a computation finer or coarser, and nothing else: `numerics.*`, the frame and the
/// trace interval, with their values.
using Setting = std::map<std::string, scene::Value>;
Setting setting_of(const scene::Scene& scene);
/// Whether a scene key belongs to a setting.
bool belongs_to_setting(const std::string& key);
/// Equal but for the round-off of units.
bool same_setting(const Setting& a, const Setting& b);

/// How good one setting is, and what it costs.
struct RecordedSetting {
  std::string label;
  Setting setting;
  double temperature_bound = 0;   ///< K, of T max, the largest over the gaps (see math::Extrapolation)
  double critical_gap_bound = 0;  ///< m, likewise; NaN where there is no critical gap
  double processor_time = 0;      ///< s
};

/// A recorded accuracy study.
struct AccuracyRecord {
  std::string title;  ///< of the accuracy study
  int model_version = 0;
  std::string shell;         ///< `shell_of` the scene
  double peak_pressure = 0;  ///< Pa
  double rise = 0;           ///< K, of T max above the initial temperature where the bounds were found
  std::vector<RecordedSetting> settings;
};

/// Digest of what the errors of a setting depend on besides the setting and the load: bodies, materials,
/// symmetry, barrel, friction closure and observation points.
std::string shell_of(const scene::Scene& scene);

std::string to_json_text(const AccuracyRecord& record);
/// Nothing for a text that is no record.
std::optional<AccuracyRecord> accuracy_record_from(const std::string& text);

/// Why a record says nothing of a scene's shell under this model; empty where it does.
std::string why_foreign(const AccuracyRecord& record, const scene::Scene& scene);
/// The recorded setting of a scene, or nullptr.
const RecordedSetting* recorded_setting(const AccuracyRecord& record, const scene::Scene& scene);
/// The cheapest setting whose T max is known to `tolerance` (K), or nullptr.
const RecordedSetting* cheapest_within(const AccuracyRecord& record, double tolerance);
/// The setting with the smallest bound, or nullptr for an empty record.
const RecordedSetting* most_accurate(const AccuracyRecord& record);

}  // namespace launchsafe::study
