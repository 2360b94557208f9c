// Numbers of the assembled mechanics: waves, statics, momentum and energy, frames, and grid heat conduction,
// each computed by a small simulation and compared with its closed form.
#pragma once

#include "launchsafe/scene/scene.hpp"
#include "launchsafe/verify/check.hpp"

#include <string>
#include <vector>

namespace launchsafe::verify {

/// One simulation (or a series of meshes) and the numbers that it must reproduce.
struct Computation {
  std::string name;
  scene::Formulation formulation = scene::Formulation::total_lagrangian;
  std::vector<Check> (*compute)(scene::Formulation) = nullptr;
  /// The checks; groups of the updated-Lagrangian form say so.
  std::vector<Check> run() const;
};

/// All of them, not yet run, so that each can be a test of its own.
std::vector<Computation> mechanics_computations();

/// Runs them one after the other: some seconds on one core.
std::vector<Check> mechanics_checks();

}  // namespace launchsafe::verify
