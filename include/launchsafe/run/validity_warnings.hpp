// Validity warnings: why a run that completed may still be no basis for a verdict.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/scene/scene.hpp"

#include <string>
#include <vector>

namespace launchsafe::run {

/// Reasons, each a clause for people, for which a completed run must not be trusted; none for a sound one.
/// They rest on the scene and on what the run recorded, so that stored runs can be judged too.
std::vector<std::string> validity_warnings(const scene::Scene& scene, const MechanicsResult& mechanics);

}  // namespace launchsafe::run
