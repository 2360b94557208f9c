// Conduction at any Fourier number: heat is kept and no new extremes appear.
#include "hard_laws.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::hard {

namespace {

constexpr double cell = 10e-3, cold = 300.0, hot = 1300.0;  // m, K

/// Neighbours are cold and hot by turns: the roughest field there is.
void make_checkered(mpm::Simulation& simulation) {
  const auto paint = [](mpm::Kinematics& p) {
    for (int j = 0; j < p.lattice.rows(); ++j)
      for (int i = 0; i < p.lattice.columns(); ++i)
        p.temperature[p.lattice.slot(i, j)] = (i + j) % 2 == 0 ? cold : hot;
  };
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>()) paint(body.kinematics);
  for (mpm::Body<materials::Charge>& body : simulation.bodies_of<materials::Charge>()) paint(body.kinematics);
}

/// Lowest and highest temperature; whether any is not a number.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool broken = false;
};
Range range_of(const mpm::Simulation& simulation) {
  Range range;
  simulation.for_each_body([&](const mpm::Kinematics& p) {
    for (int j = 0; j < p.lattice.rows(); ++j)
      for (int i = 0; i < p.lattice.columns(); ++i) {
        const double temperature = p.temperature[p.lattice.slot(i, j)];
        range.broken = range.broken || !std::isfinite(temperature);
        range.low = std::min(range.low, temperature);
        range.high = std::max(range.high, temperature);
      }
  });
  return range;
}

void conduct(mpm::Conduction& conduction, mpm::Simulation& simulation, double dt) {
  conduction.advance(simulation, dt);
}

}  // namespace

void judge_conduction(Judge& judge, const ConductionLaw& law, double fourier_number) {
  const scene::Scene shell = mechanics::shell_155(cell);
  const double dt = fourier_number * cell * cell * shell.charge().eos.initial_density *
                    shell.charge().specific_heat / shell.charge().conductivity;
  mpm::Simulation simulation(shell);
  make_checkered(simulation);
  mpm::Conduction conduction(simulation);
  const double heat = conduction.heat(simulation);
  Range last = range_of(simulation);
  for (int step = 0; step < 3; ++step) {
    law(conduction, simulation, dt);
    const Range now = range_of(simulation);
    judge.never("a temperature is not finite", now.broken);
    judge.at_most("heat made or lost, share", std::abs(conduction.heat(simulation) / heat - 1.0), 1e-12);
    judge.at_most("temperature beyond the extremes of the step before, K",
                  std::max({0.0, last.low - now.low, now.high - last.high}), 1e-9);
    last = now;
  }
  if (fourier_number >= 1e4) {
    judge.at_most("spread left after three steps, K", last.high - last.low, 1e-3);
  } else if (fourier_number >= 1e-6) {
    judge.never("nothing was conducted", !(last.high - last.low < hot - cold));
  }
}

Cases conduction_cases() {
  Cases cases;
  for (const double number : {1e-300, 1e-9, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e8}) {
    cases.push_back(
        {"stiff: conduction", fmt::format("Fourier number {:g}, checkered shell, 10 mm", number),
         "Heat is conserved to 1e-12; no temperature leaves the range of the step before; at 1e4 and "
         "beyond the shell is even after three steps.",
         [number] {
           Judge judge;
           judge_conduction(judge, conduct, number);
           return judge.finding();
         }});
  }
  cases.push_back({"stiff: conduction", "a temperature that is not a number",
                   "It does not vanish into finite neighbours.", [] {
                     Judge judge;
                     mpm::Simulation simulation(mechanics::shell_155(cell));
                     mpm::Conduction conduction(simulation);
                     mpm::Kinematics& p = simulation.bodies_of<materials::Charge>()[0].get().kinematics;
                     p.temperature[p.lattice.slot(1, 1)] = std::numeric_limits<double>::quiet_NaN();
                     conduction.advance(simulation, 1.0);
                     judge.never("all temperatures are finite again", !range_of(simulation).broken);
                     judge.caught("NaN stays NaN");
                     return judge.finding();
                   }});
  return cases;
}

}  // namespace launchsafe::verify::hard
