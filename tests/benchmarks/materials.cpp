// Cost of each material update, one particle at a time (double) and eight (Pack); items are particles.
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/steel.hpp"
#include "launchsafe/materials/visco_scram_step.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
using launchsafe::math::Pack;

constexpr std::size_t law_particles = 4096;  // fits the second-level cache

template <class Real>
constexpr std::size_t lanes = sizeof(Real) / sizeof(double);

template <class Real>
void count_particles(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(law_particles));
}

/// Closed cracks under setback pressure that grow slowly: what most of the charge does most of the time.
template <class Real>
void visco_scram(benchmark::State& state) {
  const ViscoScramParameters parameters;
  ViscoScramStep law(parameters);
  law.set_step(2e-7);
  ViscoScramStep::State<Real> virgin{};
  virgin.crack_radius = Real(parameters.initial_crack_radius);
  std::vector<ViscoScramStep::State<Real>> points(law_particles / lanes<Real>, virgin);
  const auto de = vector_of(Deviator<Real>{Real(1e-9), Real(-3e-9), Real(2e-9)});
  Real total(0.0);
  for (auto _ : state) {
    for (auto& point : points) {
      const auto end = law.update(point, de, Real(1e8));
      point = end.state;
      total += end.viscous + end.crack;
    }
    benchmark::DoNotOptimize(total);
  }
  count_particles<Real>(state);
}

/// The same law while its cracks run away (no friction, high stress), sub-stepped.
template <class Real>
void visco_scram_runaway(benchmark::State& state) {
  ViscoScramParameters parameters;
  parameters.face_friction = 0.0;
  ViscoScramStep law(parameters);
  law.set_step(2e-7);
  ViscoScramState<Real> virgin{};
  virgin.crack_radius = Real(parameters.initial_crack_radius);
  for (auto& element : virgin.elements) element.rx = Real(3e6);
  const auto start = law.state_of(virgin);
  const auto de = vector_of(Deviator<Real>{Real(0.0), Real(0.0), Real(1e-4)});
  for (auto _ : state) {
    for (std::size_t k = 0; k < law_particles / lanes<Real>; ++k) {
      auto end = law.update(start, de, Real(0.0));
      benchmark::DoNotOptimize(end);
    }
  }
  count_particles<Real>(state);
}

/// Radial return with `stress` of the first yield stress in per cent: 50 is elastic, 110 yields.
template <class Real>
void johnson_cook(benchmark::State& state) {
  const JohnsonCookParameters law;
  const double stress = 792e6 * static_cast<double>(state.range(0)) / 100.0;
  const std::vector<Deviator<Real>> trials(
      law_particles / lanes<Real>, Deviator<Real>{Real(0.0), Real(0.0), Real(stress / std::sqrt(3.0))});
  for (auto _ : state) {
    for (const auto& trial : trials) {
      auto result = johnson_cook_return(law, trial, Real(1e-3), Real(320.0), Real(2e-7));
      benchmark::DoNotOptimize(result);
    }
  }
  count_particles<Real>(state);
}

template <class Real>
void jwl(benchmark::State& state) {
  const JwlParameters law = unreacted_composition_b();
  for (auto _ : state) {
    Real v(1.0);
    for (std::size_t k = 0; k < law_particles / lanes<Real>; ++k) {
      Real pressure = jwl_isentropic_pressure(law, v), modulus = jwl_isentropic_bulk_modulus(law, v);
      benchmark::DoNotOptimize(pressure);
      benchmark::DoNotOptimize(modulus);
      v = v - Real(1e-6);
    }
  }
  count_particles<Real>(state);
}

template <class Real>
void mie_gruneisen(benchmark::State& state) {
  const MieGruneisenParameters law;
  for (auto _ : state) {
    MieGruneisenState<Real> point{Real(0.0), Real(0.0)};
    Real mu(0.0);
    for (std::size_t k = 0; k < law_particles / lanes<Real>; ++k) {
      const Real next = mu + Real(1e-6);
      point = mie_gruneisen_compress(law, mu, point.pressure, point.energy, next, Real(0.0));
      Real modulus = mie_gruneisen_bulk_modulus(law, next, point.pressure);
      benchmark::DoNotOptimize(modulus);
      mu = next;
    }
    benchmark::DoNotOptimize(point);
  }
  count_particles<Real>(state);
}

BENCHMARK(visco_scram<double>);
BENCHMARK(visco_scram<Pack>);
BENCHMARK(visco_scram_runaway<double>);
BENCHMARK(visco_scram_runaway<Pack>);
BENCHMARK(johnson_cook<double>)->Arg(50)->Arg(110);
BENCHMARK(johnson_cook<Pack>)->Arg(50)->Arg(110);
BENCHMARK(jwl<double>);
BENCHMARK(jwl<Pack>);
BENCHMARK(mie_gruneisen<double>);
BENCHMARK(mie_gruneisen<Pack>);

}  // namespace
