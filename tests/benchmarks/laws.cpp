// Cost of a law's whole update as the step calls it, eight particles at a time; items are particles.
#include "launchsafe/materials/laws.hpp"

#include "launchsafe/math/pack.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace {

using namespace launchsafe;
using materials::Increment;
using math::AlignedArray;
using math::Pack;

constexpr std::size_t particles = 1024;  // with all that they carry they fit the second-level cache
constexpr double time_step = 2.5e-7;     // s, of a mesh of 2.5 mm

/// Particles with the state of their law, under small strains to and fro about a state of a launch.
template <class Law>
struct Body {
  typename Law::Integrator integrator;
  std::array<AlignedArray, Law::state.size()> state;
  AlignedArray pressure, temperature;
  double volume = 1.0;  // over that at rest

  explicit Body(const Law& law) : integrator(law), pressure(particles, 0.0), temperature(particles, 300.0) {
    integrator.set_step(time_step);
    const auto start = law.initial_state(300.0);
    for (std::size_t f = 0; f < start.size(); ++f) state[f] = AlignedArray(particles, start[f]);
  }

  Increment<Pack> increment(double strain, double compression) const {
    const math::Deviator<Pack> de{Pack(0.3 * strain), Pack(-strain), Pack(0.5 * strain)};
    return {de, math::rotation_of(Pack(0.4 * strain)), Pack(volume), Pack(volume * (1.0 - compression))};
  }

  [[gnu::flatten]] void step(const Increment<Pack>& increment, Pack& total) {
    for (std::size_t slot = 0; slot < particles; slot += math::pack_width) {
      auto s = materials::load_state<Law>([&](std::size_t f) { return Pack::load(&state[f][slot]); });
      Pack heat = Pack::load(&temperature[slot]);
      const auto response = integrator.update(increment, s, Pack::load(&pressure[slot]), heat);
      materials::store_state<Law>(s, [&](std::size_t f, Pack value) { value.store(&state[f][slot]); });
      response.pressure.store(&pressure[slot]);
      if constexpr (Law::heats_itself) heat.store(&temperature[slot]);
      total += contract(response.deviator_before + response.deviator, increment.deviator) +
               response.pressure + response.plastic + response.viscous + response.crack +
               response.tension_cutoff + response.pressure_guard + response.crack_at_bound;
    }
  }
};

/// Loaded by `range(0)` units of strain of 1e-4 and 1 % of compression, then to and fro.
template <class Law>
void law_update(benchmark::State& state) {
  Body<Law> body(Law{});
  Pack total(0.0);
  constexpr int loading = 1000;
  const double strain = 1e-4 * static_cast<double>(state.range(0)) / loading;
  for (int k = 0; k < loading; ++k) {
    body.step(body.increment(strain, 1e-5), total);
    body.volume *= 1.0 - 1e-5;
  }
  double sign = 1.0;
  for (auto _ : state) {
    body.step(body.increment(sign * 1e-8, sign * 1e-8), total);
    sign = -sign;
  }
  benchmark::DoNotOptimize(total);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(particles));
}

BENCHMARK(law_update<materials::Steel>)->Arg(0)->Arg(10);
BENCHMARK(law_update<materials::Charge>)->Arg(0)->Arg(10)->Arg(40);
BENCHMARK(law_update<materials::LinearElastic>)->Arg(0);

}  // namespace
