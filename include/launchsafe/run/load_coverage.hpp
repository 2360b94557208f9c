// Whether a simulation covers the launch that its load states.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <string>
#include <vector>

namespace launchsafe::run {

/// What of the stated load lies outside the simulated time, a clause each for people; nothing for a launch
/// that begins at rest, reaches its stated peak, and ends after it with all that was measured. A launch may
/// end at the stated duration while pressure is left, as the shell leaves the barrel.
std::vector<std::string> uncovered_load(const scene::Load& load);

}  // namespace launchsafe::run
