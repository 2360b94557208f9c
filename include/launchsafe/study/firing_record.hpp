// What a calibration on firings found, kept for the studies that use its constants.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/calibration_domain.hpp"
#include "launchsafe/study/firing_posterior.hpp"

#include <string>

namespace launchsafe::study {

/// The launch with the constants at the middle of their posterior, and the firings.
struct FiringRecord {
  std::string title;  ///< of the calibration
  int model_version = 0;
  Calibration calibration;  ///< with firings
};

/// The record as a file, with the SHA-256 of its content.
std::string to_json_text(const FiringRecord& record);
/// Whether a text is meant to be such a record.
bool is_firing_record(const std::string& text);
/// Refuses an edited record, one of another model version, and a scene that no reader takes. `file` is named
/// in errors. Rounds that were made up and a digest that was computed anew are not recognised, as firings
/// that were made up are not: a digest guards against mistakes and idle edits. Constants of the scene that
/// are not those of the posterior buy nothing, as verdicts count with the heat that the posterior asks for.
scene::Expected<FiringRecord> parse_firing_record(const std::string& text, const std::string& file);

/// All of it as a text, of which another one is another calibration.
std::string to_text(const FiringEvidence& evidence);

}  // namespace launchsafe::study
