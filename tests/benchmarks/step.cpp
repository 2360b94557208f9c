// Cost of the step on the shipped 155 mm scene at full inertia; items are particle updates. One core.
#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/mpm/transfer.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <benchmark/benchmark.h>

#include <stdexcept>

namespace {

using namespace launchsafe;

scene::Scene shipped_scene(double cell_size) {
  const auto file =
      scene::caught([&] { return scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml"); });
  if (!file) throw std::runtime_error("the shipped scene does not read");
  scene::Scene scene = file->scene;
  scene.numerics.inertial_scaling = 1.0;
  scene.numerics.cell_size = cell_size;
  return scene;
}

void time_steps(benchmark::State& state, mpm::Simulation& simulation, int warm_up) {
  const double dt = 0.98 * simulation.stable_time_step();  // room for the compression to stiffen
  for (int k = 0; k < warm_up; ++k) simulation.step(dt);
  for (auto _ : state) simulation.step(dt);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(simulation.particles()));
}

/// Near rest, as in the first milliseconds.
void step(benchmark::State& state) {
  mpm::Simulation simulation(shipped_scene(1e-6 * static_cast<double>(state.range(0))));
  time_steps(state, simulation, 100);
}
BENCHMARK(step)->Arg(5000)->Arg(2500)->Arg(1250)->Name("step/cell_um")->Unit(benchmark::kMicrosecond);

/// From 0.4 ms on under a pulse of 496 MPa with its peak at 0.5 ms: steel yields and cracks grow.
void step_under_load(benchmark::State& state) {
  scene::Scene scene = shipped_scene(2.5e-3);
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.peak_time = 5e-4;
  mpm::Simulation simulation(scene);
  time_steps(state, simulation, 2400);
}
BENCHMARK(step_under_load)->Iterations(600)->Unit(benchmark::kMicrosecond);

/// Eight particles a go, over all rows of the charge at rest.
template <class Operation>
void over_the_charge(benchmark::State& state, Operation&& operation) {
  scene::Scene scene = shipped_scene(2.5e-3);
  scene.numerics.formulation = scene::Formulation::updated_lagrangian;
  mpm::Simulation simulation(scene);
  mpm::Grid grid = simulation.updated_lagrangian()->grid();
  const mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  const mpm::StencilContext context{grid, grid.origin_x, 0.5 * p.lattice.length_x(0),
                                    0.5 * p.lattice.length_r(0)};
  for (auto _ : state)
    for (std::size_t slot = 0; slot < p.x.size(); slot += math::pack_width)
      operation(grid, mpm::stencil_of(context, math::Pack::load(&p.x[slot]), math::Pack::load(&p.r[slot])),
                math::Pack::load(&p.mass[slot]));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(p.x.size()));
}

void grid_to_particle(benchmark::State& state) {
  over_the_charge(state, [](const mpm::Grid& grid, const mpm::Stencil& stencil, math::Pack mass) {
    auto read = mpm::grid_to_particle(grid, stencil, mass > math::Pack(0.0));
    benchmark::DoNotOptimize(read);
  });
}
BENCHMARK(grid_to_particle)->Unit(benchmark::kMicrosecond);

void particle_to_grid(benchmark::State& state) {
  over_the_charge(state, [](mpm::Grid& grid, const mpm::Stencil& stencil, math::Pack mass) {
    mpm::particle_to_grid(grid, stencil, {mass, mass, mass, mass, mass, mass, mass, mass},
                          mass > math::Pack(0.0));
  });
}
BENCHMARK(particle_to_grid)->Unit(benchmark::kMicrosecond);

}  // namespace
