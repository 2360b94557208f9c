// Shared by the sources of a calibration: the keys that are fitted, and the published rows that set bounds.
#pragma once

#include "launchsafe/kinds/calibration.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using scene::Constants, scene::FittedNumber;

/// Keys of a scene whose values a constants file holds, besides those that are fitted and those of faces.
const std::vector<std::string>& constant_keys();

/// The keys that a study fits; throws a fault at `fit` for one that has no positive number in its scene.
std::vector<FittedKey> keys_to_fit(const StudyFile& study);

/// The published rows with the largest gap that did not ignite, and with the smallest that did.
const Reference& largest_safe(const StudyFile& study);
const Reference& smallest_igniting(const StudyFile& study);

}  // namespace launchsafe::kinds
