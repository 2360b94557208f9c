// What a scene and a study will compute and what that will cost, for people and programs, and how fast this
// machine is.
#pragma once

#include "console.hpp"

namespace launchsafe::app {

/// What of a scene is computed, on which grid, and at what cost, in SI; particle updates per second > 0.
Json scene_json(const scene::Scene& scene, double update_rate);
/// The same for people. `facts`: those for programs.
std::string scene_text(const scene::Scene& scene, Json facts);

/// Peaks, end, exit and smoothing of a load, in SI.
Json load_json(const scene::Scene& scene);

/// What of a launch a load does not cover, for which no verdict stands; empty for none.
std::string uncovered_text(const scene::Load& load);

/// What a study would run, and at what cost, for programs. Throws Ended where the user stops it.
Json estimate_json(const study::StudyFile& file, const study::StudyOptions& options);
/// The same for people. `facts`: those for programs.
std::string estimate_text(const study::StudyFile& file, Json facts);

}  // namespace launchsafe::app
