// A body that flies across a gap with gas in it, against closed forms of model section 14.
#include "contact_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace {

using namespace launchsafe;
using namespace launchsafe::test_support;

constexpr double atmosphere = 101325.0;                   // Pa
constexpr double load_per_area = 1717.0 * 0.56 * 1000.0;  // Pa: rho L a of the charge at 1000 m/s2
constexpr double fall = load_per_area / (block_density * block_height);  // m/s2 of the block for that load

mpm::Contact& contact_of(LoadedSimulation& simulation) { return simulation.total_lagrangian()->contact(); }

/// Whether each node has gas of its own, or all share it.
enum class Gas { of_nodes, common };

/// A block above the floor by a gap (m), down to a floor, with gas that is compressed by `exponent`; 0: none.
void part_block(LoadedSimulation& simulation, double gap, double floor, double exponent,
                double covolume = 0.0, Gas kind = Gas::of_nodes) {
  mpm::Contact& contact = contact_of(simulation);
  contact.part(0, gap, floor);
  if (!(exponent > 0.0)) return;
  if (kind == Gas::common)
    return contact.set_common_gas({atmosphere, atmosphere, gap - covolume, exponent, covolume});
  for (std::size_t node = 0; node < contact.state_of(0).size(); ++node)
    contact.set_gas(0, node, {atmosphere, atmosphere, gap - covolume, exponent, covolume});
}

/// Lets the block fall; the first step moves it by half a step's speed, as that is at the middle of a step.
void let_fall(LoadedSimulation& simulation, double acceleration, double step) {
  simulation.apply_body_force(1, 0.0, -0.5 * acceleration);
  simulation.step(step);
  simulation.apply_body_force(1, 0.0, -0.5 * acceleration);
}

scene::Scene block_of(double shear) {
  scene::Scene scene = block_on_floor(sliding("", 0.0));
  scene.materials = {plain("floor", 1e6 * shear, 0.0, 1e6 * block_density),
                     plain("block", shear, 0.0, block_density)};
  return scene;
}

double opening_of(LoadedSimulation& simulation) { return contact_of(simulation).opening(0, 2); }

/// m, the smallest opening that a block falls to with its gas.
double smallest_opening(double shear, double gap, double exponent, double step_share = 1.0,
                        double acceleration = fall, double covolume = 0.0, Gas kind = Gas::of_nodes) {
  LoadedSimulation simulation(block_of(shear));
  part_block(simulation, gap, 1e-3 * gap, exponent, covolume, kind);
  let_fall(simulation, acceleration, step_share * simulation.stable_time_step());
  // The parabola through the three lowest, so that no step has to meet the turning point.
  double a = gap, b = gap, c = gap;
  while (c <= b) {
    simulation.step(step_share * simulation.stable_time_step());
    a = b;
    b = c;
    c = opening_of(simulation);
  }
  const double slope = 0.5 * (c - a), curvature = a - 2.0 * b + c;
  return curvature > 0.0 ? b - 0.5 * slope * slope / curvature : b;
}

TEST(GapGas, ABlockBouncesWhereItsGasHasTakenItsFall) {
  // p0/0.4 ((h0/h)^0.4 - 1) = (rho L a + p0)(1 - h/h0).
  const double shear = 5e13;
  const double adiabatic = 1e-3 / smallest_opening(shear, 1e-3, 1.4);
  EXPECT_NEAR(adiabatic, 59.468, 1e-3 * 59.468);
  EXPECT_NEAR(300.0 * std::pow(adiabatic, 0.4), 1537.6, 1e-3 * 1537.6);
  // A flat block closes alike everywhere: gas that flows does not.
  EXPECT_NEAR(1e-3 / smallest_opening(shear, 1e-3, 1.4, 1.0, fall, 0.0, Gas::common), adiabatic,
              1e-6 * adiabatic);
}

TEST(GapGas, ACovolumeTakesPartOfTheGap) {
  // What is left of the gap beside it follows the law without one.
  const double covolume = 1e-5;
  const double left = smallest_opening(5e13, 1e-3 + covolume, 1.4, 1.0, fall, covolume) - covolume;
  EXPECT_NEAR(1e-3 / left, 59.468, 1e-3 * 59.468);
}

TEST(GapGas, ABlockBouncesLaterWhereItsGasStaysCold) {
  // p0 ln(h0/h) = (rho L a + p0)(1 - h/h0) where it keeps its temperature.
  const double load = 3.0 * atmosphere;
  double ratio = 10.0;
  for (int i = 0; i < 100; ++i) ratio = std::exp((load / atmosphere + 1.0) * (1.0 - 1.0 / ratio));
  const double measured =
      1e-3 / smallest_opening(5e13, 1e-3, 1.0, 1.0, load / (block_density * block_height));
  EXPECT_NEAR(measured, ratio, 1e-3 * ratio);
}

TEST(GapGas, PushesNothingAtThePressureOutside) {
  LoadedSimulation simulation(block_of(1e9));
  part_block(simulation, 1e-3, 1e-6, 1.4);
  for (int step = 0; step < 1000; ++step) simulation.step(simulation.stable_time_step());
  EXPECT_DOUBLE_EQ(opening_of(simulation), 1e-3);
}

TEST(GapGas, ABodyFliesAndMeetsTheFloorWithItsImpedance) {
  // t = sqrt(2 h0/a), v = sqrt(2 a h0), then p = Z (v + a t) until a wave has been to the far end and back.
  const double gap = 1e-4, acceleration = 1e6, shear = 1e9;
  LoadedSimulation simulation(block_of(shear));
  part_block(simulation, gap, 1e-9, 0.0);
  simulation.apply_body_force(1, 0.0, -acceleration);
  double before = gap, time = 0.0;
  while (opening_of(simulation) > 1.001e-9) {
    before = opening_of(simulation);
    simulation.step(0.1 * simulation.stable_time_step());
    time = simulation.time();
  }
  const double step = 0.1 * simulation.stable_time_step();
  EXPECT_NEAR(time, std::sqrt(2.0 * gap / acceleration), 1.5 * step + 1e-3 * time);
  EXPECT_GT(before, 1e-9);
  const double speed = std::sqrt(2.0 * acceleration * gap), sound = std::sqrt(2.0 * shear / block_density);
  const double back = 2.0 * block_height / sound, contact = time;
  // Averaged over the middle of that time: a step in stress oscillates on any lattice.
  double impulse = 0.0, expected = 0.0;
  while (simulation.time() < contact + 0.75 * back) {
    simulation.step(step);
    const double since = simulation.time() - contact;
    if (since < 0.25 * back) continue;
    impulse += contact_of(simulation).state_of(0)[2].pressure * step;
    expected += block_density * sound * (speed + acceleration * since) * step;
  }
  EXPECT_NEAR(impulse, expected, 0.02 * expected);
}

TEST(GapGas, IsOfSecondOrderInTheStep) {
  for (const Gas kind : {Gas::of_nodes, Gas::common}) {
    const auto at = [&](double share) { return smallest_opening(1e12, 1e-3, 1.4, share, fall, 0.0, kind); };
    const double coarse = at(1.0), middle = at(0.5), fine = at(0.25);
    EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 2.0, 0.4);
  }
}

TEST(GapGas, ClosesTheEnergyBalanceWithItsWork) {
  // What is left of an impact on the floor is the third power of a step's strain, as without gas.
  struct Row {
    double exponent, limit;
    Gas kind;
  };
  for (const auto& [exponent, limit, kind] :
       {Row{0.0, 1e-4, Gas::of_nodes}, Row{1.0, 1e-4, Gas::of_nodes}, Row{1.4, 2e-7, Gas::of_nodes},
        Row{1.0, 1e-4, Gas::common}, Row{1.4, 2e-7, Gas::common}}) {
    LoadedSimulation simulation(block_of(1e12));
    part_block(simulation, 1e-3, 1e-5, exponent, 0.0, kind);
    let_fall(simulation, fall, simulation.stable_time_step());
    double largest = 0.0, scale = 0.0;
    for (int step = 0; step < 20000; ++step) {
      simulation.step(simulation.stable_time_step());
      const mpm::EnergyTotals& e = simulation.energy();
      largest = std::max(largest, std::abs(ledger(e)));
      scale = std::max(scale, e.kinetic + e.internal + std::abs(e.contact));
      ASSERT_GE(opening_of(simulation), 1e-5 * (1.0 - 1e-6));
    }
    EXPECT_LT(largest / scale, limit) << exponent;
  }
}

TEST(GapGas, ItsWorkIsThatOfTheLaw) {
  // U = p h/(gamma - 1) of the gas, less the work against the pressure outside.
  for (const Gas kind : {Gas::of_nodes, Gas::common}) {
    LoadedSimulation simulation(block_of(1e12));
    const double gap = 1e-3;
    part_block(simulation, gap, 1e-6, 1.4, 0.0, kind);
    let_fall(simulation, fall, simulation.stable_time_step());
    double now = gap;  // to which the work is known: at the begin of the last step
    while (opening_of(simulation) > 0.1 * gap) {
      now = opening_of(simulation);
      simulation.step(simulation.stable_time_step());
    }
    const double work = atmosphere * gap / 0.4 * (std::pow(gap / now, 0.4) - 1.0) - atmosphere * (gap - now);
    EXPECT_NEAR(contact_of(simulation).gas_work(0, 2), work, 1e-4 * work);
  }
}

}  // namespace
