// One case as people and programs read it.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

/// A table of the gaps, then the energy balance, the limiters that acted, and what the run cost.
std::string case_text(const scene::Scene& scene, const run::CaseResult& result);

/// The same for programs, in SI units but for the gaps (see the keys).
nlohmann::ordered_json case_json(const scene::Scene& scene, const run::CaseResult& result);

}  // namespace launchsafe::app
