// The skin of one gap on the finished trace of a coarse launch.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace launchsafe;

void gap_on_a_trace(benchmark::State& state) {
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").scene;
  scene.numerics.cell_size = 20e-3;
  scene.numerics.inertial_scaling = 400.0;
  const trace::BottomTrace trace = run::run_mechanics(scene).trace;
  for ([[maybe_unused]] const auto _ : state) {
    run::GapResult gap = run::evaluate_gap(scene, trace, 4e-4);
    benchmark::DoNotOptimize(gap);
  }
}
BENCHMARK(gap_on_a_trace)->Unit(benchmark::kMillisecond);

}  // namespace
