// What the skin takes from the air against what compression can supply to it.
#include "launchsafe/surface/skin.hpp"
#include "plain_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

using namespace launchsafe;
using namespace launchsafe::surface;

constexpr double p0 = 101325.0;         // Pa
constexpr double capacity = 305.626;    // J/(m2 K): 1717 * 1780 * 1e-4
constexpr double air_mass = 4.7064e-4;  // kg/m2 in 0.04 cm: 1.1766 * 4e-4

/// Two stations over 18 ms under a pressure (Pa), with friction (J/m3 by the end) that grows evenly.
trace::BottomTrace under(const std::function<double(double)>& pressure, double friction, int intervals) {
  trace::BottomTrace trace;
  trace.stations = {{"S1", 0.678, 0.0625, 1e-3, false}, {"S2", 0.678, 0.0575, 1e-3, false}};
  for (int sample = 0; sample <= intervals; ++sample) {
    const double dt = 18e-3 / intervals, t = dt * sample;
    const double mean =
        sample == 0 ? pressure(0.0) : (pressure(t - dt) + 4.0 * pressure(t - 0.5 * dt) + pressure(t)) / 6.0;
    trace.time.push_back(t);
    for (auto* values : {&trace.bottom_pressure, &trace.chamber_pressure}) values->push_back(pressure(t));
    trace.mean_bottom_pressure.push_back(mean);
    trace.friction.push_back(friction * t / 18e-3);
    trace.friction.push_back(0.9 * friction * t / 18e-3);
  }
  return trace;
}

/// The load of the 155 mm shell, with 118 MPa on the bottom.
double launch(double t) { return p0 + (118e6 - p0) * std::pow(t / 11e-3 * std::exp(1.0 - t / 11e-3), 12.0); }

/// Up within 1 ms, and then held.
double held(double t) { return p0 + 118e6 * std::min(t / 1e-3, 1.0); }

SkinModel inert() {
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = 1e9;
  model.kinetics.burnt_temperature = 1e9;
  return model;
}

AirEnergy audited(const SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return audit_air(model, trace, integrate_skin(model, trace, gap));
}

// At 0.04 cm and 118 MPa, 2256 K.
TEST(AirEnergy, SupplyIsTheRiseOfEnthalpyOnTheAdiabat) {
  const AirEnergy energy = audited(inert(), under(launch, 0.0, 900), 4e-4);
  const double hot = 300.0 * std::pow(118e6 / p0, 2.0 / 7.0);
  EXPECT_NEAR(hot, 2256.0, 1.0);
  EXPECT_NEAR(energy.supplied, air_mass * 1005.0 * (hot - 300.0), 0.01);
  EXPECT_NEAR(energy.supplied, 925.0, 1.0);
}

// In closed form: up to 4 p0, down to 2 p0, and up to 4 p0 again.
TEST(AirEnergy, EveryRiseOfThePressureSupplies) {
  const auto zigzag = [](double t) {
    const double part = t / 6e-3;  // 0 to 3
    if (part < 1.0) return p0 * (1.0 + 3.0 * part);
    return part < 2.0 ? p0 * (4.0 - 2.0 * (part - 1.0)) : p0 * (2.0 + 2.0 * (part - 2.0));
  };
  const double four = 300.0 * std::pow(4.0, 2.0 / 7.0), two = 300.0 * std::pow(2.0, 2.0 / 7.0);
  const double gap = 4e-4;
  const trace::BottomTrace trace = under(zigzag, 0.0, 900);
  EXPECT_NEAR(compression_supply(inert(), trace, gap, 18e-3), air_mass * 1005.0 * (four - 300.0 + four - two),
              1e-6);
  EXPECT_NEAR(compression_supply(inert(), trace, gap, 6e-3), air_mass * 1005.0 * (four - 300.0), 1e-6);
}

TEST(AirEnergy, AirThatBeginsWarmerThanTheChargeSuppliesThatToo) {
  SkinModel model = inert();
  model.initial_temperature = 290.0;
  const auto still = [](double) { return p0; };
  EXPECT_NEAR(compression_supply(model, under(still, 0.0, 10), 4e-4, 18e-3), air_mass * 1005.0 * 10.0, 1e-9);
}

// With neither friction nor reaction the skin's heat is all that it took.
TEST(AirEnergy, TakenIsTheHeatOfASkinThatNothingElseHeats) {
  const SkinModel model = inert();
  const trace::BottomTrace trace = under(held, 0.0, 900);
  const SkinHistory history = integrate_skin(model, trace, 4e-4);
  const double rise = history.temperature.back() - 300.0;
  EXPECT_GT(rise, 50.0);
  EXPECT_NEAR(heat_taken(model, trace, history), capacity * rise, 1e-3 * capacity);
}

/// rho c h_ex times the integral of (kappa h/tau_ex)(T_air - T) over the samples of the first station, J/m2.
double integrated_exchange(const SkinModel& model, const SkinHistory& history, double end) {
  const double rate = heat_capacity_ratio(model, history.gap) / model.surface.exchange_time;
  double sum = 0.0, most = 0.0;
  for (std::size_t sample = 1; sample < history.time.size() && history.time[sample] <= end; ++sample) {
    const auto difference = [&](std::size_t at) {
      return history.air_temperature[at] - history.temperature[2 * at];
    };
    sum += 0.5 * (difference(sample) + difference(sample - 1)) *
           (history.time[sample] - history.time[sample - 1]);
    most = std::max(most, sum);
  }
  return capacity * rate * most;
}

// Against trapezoids on a trace ten times as fine, with friction (108 K) and a reaction that adds kelvins.
TEST(AirEnergy, TakenAgreesWithTheIntegralOfTheExchange) {
  SkinModel model = plain_model();
  model.kinetics.ignition_temperature = 700.0;
  for (const double gap : {1e-4, 2e-4, 3.5e-4}) {
    const trace::BottomTrace trace = under(launch, 1.1e6, 900), fine = under(launch, 1.1e6, 9000);
    const SkinHistory history = integrate_skin(model, trace, gap);
    ASSERT_FALSE(history.ignition) << gap;
    const double expected = integrated_exchange(model, integrate_skin(model, fine, gap), 18e-3);
    EXPECT_NEAR(heat_taken(model, trace, history) / expected, 1.0, 1e-3) << gap;
  }
}

TEST(AirEnergy, TakenEndsWhereTheSkinIgnites) {
  const SkinModel model = plain_model();
  const trace::BottomTrace trace = under(launch, 1.1e6, 900), fine = under(launch, 1.1e6, 9000);
  const SkinHistory history = integrate_skin(model, trace, 8e-4), exact = integrate_skin(model, fine, 8e-4);
  ASSERT_TRUE(history.ignition);
  ASSERT_EQ(history.ignition->station, 0u);
  const double expected = integrated_exchange(model, exact, exact.ignition->time);
  EXPECT_NEAR(heat_taken(model, trace, history) / expected, 1.0, 5e-3);
  const AirEnergy energy = audit_air(model, trace, history);
  EXPECT_EQ(energy.supplied, compression_supply(model, trace, 8e-4, history.ignition->time));
}

// Between T1 and T2 a small heat of reaction counts all heating 1/(1 - gain) times; gain = 0.5 here.
TEST(AirEnergy, HeatThatReactionReleasesIsNotTaken) {
  SkinModel model = plain_model();
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = 350.0;
  model.kinetics.burnt_temperature = 1000.0;
  model.kinetics.heat_of_reaction = 0.5 * 650.0 * 1780.0;
  const trace::BottomTrace trace = under(held, 0.0, 900);
  const SkinHistory history = integrate_skin(model, trace, 2e-4);
  const double last = history.temperature.back();
  ASSERT_GT(last, 360.0);
  ASSERT_FALSE(history.ignition);
  EXPECT_NEAR(heat_taken(model, trace, history), capacity * (50.0 + 0.5 * (last - 350.0)), 0.5);
}

TEST(AirEnergy, WithoutAGapThereIsNone) {
  const AirEnergy energy = audited(plain_model(), under(launch, 1e6, 90), 0.0);
  EXPECT_EQ(energy.taken, 0.0);
  EXPECT_EQ(energy.supplied, 0.0);
}

TEST(AirEnergy, AHistoryThatIsNotFiniteOrOfAnotherTraceHasNone) {
  const SkinModel model = plain_model();
  const trace::BottomTrace trace = under(launch, 0.0, 90);
  SkinHistory history = integrate_skin(model, trace, 4e-4);
  EXPECT_TRUE(std::isnan(audit_air(model, under(launch, 0.0, 91), history).taken));
  history.temperature[5] = std::nan("");
  EXPECT_TRUE(std::isnan(audit_air(model, trace, history).taken));
  EXPECT_TRUE(std::isnan(audit_air(model, {}, {}).supplied));
}

}  // namespace
