// What a user says of values that are allowed but not plausible: accept = [{ key = "...", because = "..." }]
// in a scene or a study.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <string>
#include <vector>

namespace launchsafe::scene {

/// Accepts no value but the use of constants outside of what they were calibrated on, which only a study
/// knows.
inline constexpr const char* foreign_calibration = "calibration";
/// Likewise a peak pressure beyond those at which other models of the launch were compared.
inline constexpr const char* pressure_of_models = "model_form.pressure";

const std::vector<Key<Acceptance>>& acceptance_keys();

/// Why a text is no reason in words, such as "x" or one of several lines: the fault of `key` at a place.
std::optional<InputError> check_reason(const std::string& text, const Place& place, const std::string& key);

/// The table "accept" of a file; none if it has none. Faults: a key that is not among `known`, one that
/// stands there twice, a reason without letters or of several lines.
Expected<std::vector<Acceptance>> read_acceptances(const toml::table& root,
                                                   const std::vector<std::string>& known,
                                                   const std::string& file);

/// Adds an acceptance; it replaces an earlier one of the same key.
void accept(std::vector<Acceptance>& accepted, Acceptance acceptance);

/// Why the value of a key is accepted; empty if it is not.
std::string reason_for(const std::vector<Acceptance>& accepted, const std::string& key);

}  // namespace launchsafe::scene
