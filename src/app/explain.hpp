// What a scene and a study will compute and what that will cost, for people and programs; how fast this
// machine is; and what the program says of itself.
#pragma once

#include "console.hpp"

namespace launchsafe::app {

struct ExplainArguments {
  path file;  ///< scene or study; with one of the lists that follow the beginning of names, or empty
  bool keys = false, results = false, warnings = false;
  bool lists() const { return keys || results || warnings; }
};

/// What of a scene is computed, on which grid, and at what cost, in SI; particle updates per second > 0.
Json scene_json(const scene::Scene& scene, double update_rate);
/// The same for people. `facts`: those for programs.
std::string scene_text(const scene::Scene& scene, Json facts);

/// Peaks, end, exit and smoothing of a load, in SI.
Json load_json(const scene::Scene& scene);

/// What of a launch a load does not cover, for which no verdict stands; empty for none.
std::string uncovered_text(const scene::Load& load);

/// What a study would run, and at what cost, for programs. Ends the command where the user stops it.
Json estimate_json(const study::StudyFile& file, const study::StudyOptions& options, Console& console);
/// The same for people. `facts`: those for programs.
std::string estimate_text(const study::StudyFile& file, Json facts);

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run, on a coarser mesh where its own has very many particles. Ends the command where
/// the user stops it.
double measured_update_rate(const scene::Scene& scene, Console& console);

/// Prints keys, columns of results, or validity warnings.
ExitCode explain_program(const ExplainArguments& arguments, Console& console);

}  // namespace launchsafe::app
