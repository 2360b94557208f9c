#include "update_rate.hpp"

#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "signals.hpp"

#include <atomic>
#include <chrono>
#include <cmath>

namespace launchsafe::app {
namespace {

/// More than fit into a core's own cache, and few enough to be made in a moment.
constexpr std::int64_t most_particles = 50'000;

/// The scene on a mesh of so few particles, recording next to nothing.
scene::Scene measurable(scene::Scene scene) {
  constexpr double largest_cell = 1.0;  // m
  while (scene::particle_count(scene) > most_particles && scene.numerics.cell_size < largest_cell)
    scene.numerics.cell_size *= std::sqrt(2.0);
  scene.output.snapshot_times.clear();
  scene.output.snapshot_events.clear();
  scene.output.trace_interval = scene::end_time(scene.load);
  return scene;
}

}  // namespace

using namespace std::chrono_literals;

std::optional<double> measured_update_rate(const scene::Scene& scene, Console& console) {
  std::atomic<bool> enough{false};
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &enough;
  options.progress = [&](double) {
    if (std::chrono::steady_clock::now() - start > 300ms || stop_requested()) enough = true;
  };
  const run::MechanicsResult run = run::run_mechanics(measurable(scene), options);
  // What is predicted is wall time, on a machine as busy as it is.
  const double rate = run.wall_time > 0.0 ? run.particle_updates() / run.wall_time : 0.0;
  if (stop_requested()) {
    console.error("interrupted while measuring the speed of this machine; there is nothing to keep");
    return std::nullopt;
  }
  return rate > 0.0 ? rate : run::cautious_update_rate;  // where the run breaks at its first step
}

}  // namespace launchsafe::app
