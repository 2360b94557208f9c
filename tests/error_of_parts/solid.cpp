// Visco-SCRAM: relaxation and loading without cracks, which it integrates exactly, and with growing cracks.
#include "series.hpp"
#include "support/visco_scram_update.hpp"

#include <cmath>

namespace launchsafe::error_of_parts {
namespace {

using math::Pack;
using test_support::ViscoScramParameters;
using State = test_support::ElementsState<Pack>;

/// Shear at a constant rate (1/s) for a time (s), of equal particles in one Pack, as the program does.
State sheared(const ViscoScramParameters& solid, State state, double rate, double time, int steps) {
  materials::ViscoScram law(solid);
  law.set_step(time / steps);
  const auto increment = vector_of(math::Deviator<Pack>{Pack(0.0), Pack(0.0), Pack(rate * time / steps)});
  auto now = test_support::state_of(state);
  for (int k = 0; k < steps; ++k) now = law.update(now, increment, Pack(0.0)).state;
  return test_support::elements_of(now);
}

double shear_stress(const State& state) { return test_support::total_deviator(state).rx[0]; }

ViscoScramParameters uncracked() {
  ViscoScramParameters solid;
  solid.flaw_size = 0.0;
  return solid;
}

State at_rest(const ViscoScramParameters& solid) {
  State state{};
  state.crack_radius = Pack(solid.initial_crack_radius);
  return state;
}

constexpr double relaxing_time = 1e-4;  // s

/// Relative error of the stress after a sudden strain is held, sum 2 G_n strain exp(-t/tau_n), or, at a
/// `rate` (1/s), after loading at it, sum 2 G_n rate tau_n (1 - exp(-t/tau_n)).
double uncracked_error(double strain, double rate, int steps) {
  const ViscoScramParameters solid = uncracked();
  State state = at_rest(solid);
  double exact = 0.0;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n) {
    const double stiffness = 2.0 * solid.shear_moduli[n], relaxed = solid.relaxation_rates[n];
    const double time = relaxed > 0.0 ? -std::expm1(-relaxing_time * relaxed) / relaxed : relaxing_time;
    state.elements[n].rx = Pack(stiffness * strain);
    exact += stiffness * (strain * std::exp(-relaxing_time * relaxed) + rate * time);
  }
  return shear_stress(sheared(solid, state, rate, relaxing_time, steps)) / exact - 1.0;
}

std::vector<Setting> uncracked_settings(double strain, double rate) {
  return settings_for({1, 10, 100, 1000}, [=](int steps) {
    return with_steps(relaxing_time, steps, [=] { return uncracked_error(strain, rate, steps); });
  });
}

double crack_radius(const State& state) { return state.crack_radius[0]; }

/// Relative errors under shear at a constant rate (1/s) for a time (s) that makes the cracks grow, against
/// those of `fine` steps.
std::vector<Setting> growth_settings(double rate, double time, double (*quantity)(const State&),
                                     std::initializer_list<int> settings, int fine) {
  const auto value = [=](int steps) {
    const ViscoScramParameters solid;
    return quantity(sheared(solid, at_rest(solid), rate, time, steps));
  };
  return settings_for(settings, [=, reference = value(fine)](int steps) {
    return with_steps(time, steps, [=] { return value(steps) / reference - 1.0; });
  });
}

}  // namespace

std::vector<ErrorSeries> solid_series() {
  const std::string part = "Visco-SCRAM", exact = "sum over the Maxwell elements";
  const std::string elements = "exact at any step: the relaxation is integrated by exponentials";
  // 200/s for 30 us: the radius grows by half a per cent. 1000/s for 10 us: from 30 to 563 um.
  // The signed error of the runaway passes through zero between these steps (2e-7 at 78 ns): no single
  // setting of it says how good the next one is.
  return {{part, "stress relaxing, no cracks", "8 particles over 0.1 ms", exact, "", elements, exact_order,
           1e-12, uncracked_settings(1e-3, 0.0)},
          {part, "stress loaded, no cracks", "8 particles over 0.1 ms at 100/s", exact, "", elements,
           exact_order, 1e-12, uncracked_settings(0.0, 100.0)},
          {part, "radius of slow cracks", "8 particles over 30 us at 200/s",
           "itself with 16384 steps (no exact solution)", "",
           "second order in the step, below about 0.5 us, where no step is divided", 2.0, 1e-11,
           growth_settings(200.0, 30e-6, crack_radius, {64, 128, 256, 512, 1024}, 16384)},
          {part, "stress, runaway cracks", "8 particles over 10 us at 1000/s",
           "itself with 131072 steps, good to 1e-6 (no exact solution)", "",
           "none: sub-steps, of at most a hundredth of the radius each, bound the error before the step does",
           no_order, 1e-11, growth_settings(1000.0, 10e-6, shear_stress, {4, 16, 64, 256, 1024}, 131072)}};
}

}  // namespace launchsafe::error_of_parts
