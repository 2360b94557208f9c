// Conduction at any Fourier number: heat is kept and no new extremes appear.
#include "law_tests.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::law_tests {

namespace {

constexpr double cell = 10e-3, cold = 300.0, hot = 1300.0;  // m, K

/// Neighbours are cold and hot alternately, the largest differences there can be.
void make_checkered(mpm::Simulation& simulation) {
  simulation.for_each_body([](mpm::ParticleFields& p) {
    for (int j = 0; j < p.lattice.rows(); ++j)
      for (int i = 0; i < p.lattice.columns(); ++i)
        p.temperature[p.lattice.slot(i, j)] = (i + j) % 2 == 0 ? cold : hot;
  });
}

void conduct(mpm::Conduction& conduction, mpm::Simulation& simulation, double dt) {
  conduction.advance(simulation, dt);
}

}  // namespace

void assess_conduction(Bounds& bounds, const ConductionLaw& law, double fourier_number) {
  mpm::Simulation simulation(mechanics::shell_155(cell));
  const double dt = mechanics::step_of_fourier_number(simulation.scene().charge(), cell, fourier_number);
  make_checkered(simulation);
  mpm::Conduction conduction(simulation);
  const double heat = conduction.heat(simulation);
  mechanics::TemperatureRange last = mechanics::range_of(simulation);
  for (int step = 0; step < 3; ++step) {
    law(conduction, simulation, dt);
    const mechanics::TemperatureRange now = mechanics::range_of(simulation);
    bounds.never("a temperature is not finite", !now.finite);
    bounds.at_most("heat made or lost, share", std::abs(conduction.heat(simulation) / heat - 1.0), 1e-12);
    bounds.at_most("temperature beyond the extremes of the step before, K",
                   std::max({0.0, last.low - now.low, now.high - last.high}), 1e-9);
    last = now;
  }
  if (fourier_number >= 1e4) {
    bounds.at_most("spread left after three steps, K", last.high - last.low, 1e-3);
  } else if (fourier_number >= 1e-6) {
    bounds.never("nothing was conducted", !(last.high - last.low < hot - cold));
  }
}

LawTests conduction_tests() {
  LawTests tests;
  for (const double number : {1e-300, 1e-9, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e8}) {
    tests.push_back({"stiff: conduction", fmt::format("Fourier number {:g}, checkered shell, 10 mm", number),
                     "Heat is conserved to 1e-12; no temperature leaves the range of the step before; at 1e4 "
                     "and beyond the shell is even after three steps.",
                     [number](Bounds& bounds) { assess_conduction(bounds, conduct, number); }});
  }
  tests.push_back({"stiff: conduction", "a temperature that is not a number",
                   "It does not vanish into finite neighbours.", [](Bounds& bounds) {
                     mpm::Simulation simulation(mechanics::shell_155(cell));
                     mpm::Conduction conduction(simulation);
                     mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
                     p.temperature[p.lattice.slot(1, 1)] = std::numeric_limits<double>::quiet_NaN();
                     conduction.advance(simulation, 1.0);
                     bounds.never("all temperatures are finite again",
                                  mechanics::range_of(simulation).finite);
                     bounds.caught("NaN stays NaN");
                   }});
  return tests;
}

}  // namespace launchsafe::verify::law_tests
