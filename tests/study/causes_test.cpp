// The share of every cause in the critical gap of a launch whose skin has a closed form: under a constant
// pressure, without friction and reaction, T = T_air - (T_air - T0) exp(-a h t) for a gap h.
#include "launchsafe/study/causes.hpp"

#include "launchsafe/scene/load.hpp"
#include "launchsafe/surface/after_launch.hpp"
#include "study/synthetic_launch.hpp"

#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

constexpr double pressure = 140e6, duration = 18e-3;  // Pa, s
/// m: a critical gap is the middle of an interval that is no wider than its accuracy.
constexpr double solved = 1.5 * gap_accuracy;

run::MechanicsResult launch(double bottom_pressure = pressure, double time = duration) {
  constexpr int intervals = 50;
  run::MechanicsResult result;
  trace::BottomTrace& trace = result.trace;
  trace.stations = {{"S1", 0.678, 0.03, 1e-4, false}};
  for (int sample = 0; sample <= intervals; ++sample) {
    trace.time.push_back(time * sample / intervals);
    for (auto* history : {&trace.chamber_pressure, &trace.bottom_pressure, &trace.mean_bottom_pressure})
      history->push_back(bottom_pressure);
    trace.friction.push_back(0.0);
  }
  return result;
}

/// The launch of a gap or companion whose critical gap is that of the case times a factor.
run::MechanicsResult launch_with_gap_times(double factor) { return launch(pressure, duration / factor); }

FinishedRun finished(Part part, run::MechanicsResult mechanics) {
  FinishedRun run;
  run.outcome = RunOutcome::ran;
  run.result.mechanics = std::move(mechanics);
  run.part = part;
  return run;
}

double air_of(const surface::SkinModel& skin, double bottom_pressure) {
  return materials::adiabatic_temperature(skin.surface.air, bottom_pressure);
}
/// a, 1/(m s).
double rate_of(const surface::SkinModel& skin) {
  return surface::heat_capacity_ratio(skin, 1.0) / skin.surface.exchange_time;
}
double temperature_of(const surface::SkinModel& skin, double gap) {
  const double air = air_of(skin, pressure);
  return air - (air - skin.initial_temperature) * std::exp(-rate_of(skin) * gap * duration);
}
double critical_gap_of(const surface::SkinModel& skin, double bottom_pressure = pressure) {
  const double rise = skin.kinetics.ignition_temperature - skin.initial_temperature;
  return -std::log1p(-rise / (air_of(skin, bottom_pressure) - skin.initial_temperature)) /
         (rate_of(skin) * duration);
}

/// A case of the shipped scene whose charge does not react but at its ignition temperature.
class Causes : public ::testing::Test {
 protected:
  StudyFile file = study_of(critical_kind + "gaps = \"0.01 cm\"\n");
  Study study = file.study;
  StudyCase input = file.cases.front();
  std::vector<FinishedRun> runs{finished(Part::own, launch())};

  Causes() { input.scene.scene.charge().kinetics.frequency = 0.0; }

  surface::SkinModel skin() const { return surface::skin_model(input.scene.scene); }
  double critical_gap() const { return critical_gap_of(skin()); }
  /// m that a change of T max (K) is, by the slope of the closed form below the critical gap.
  double length_of(double temperature) const {
    const double end = critical_gap(), begin = 0.9 * end;
    return temperature * (end - begin) / (temperature_of(skin(), end) - temperature_of(skin(), begin));
  }
  CauseShare share_of(Cause cause, double critical) const {
    const auto shares = causes_of(study, input, runs, {CriticalGapKind::value, critical});
    const auto found = std::ranges::find(shares, cause, &CauseShare::cause);
    EXPECT_NE(found, shares.end());
    return found == shares.end() ? CauseShare{} : *found;
  }
  CauseShare share_of(Cause cause) const { return share_of(cause, critical_gap()); }
  /// Moves by launches whose critical gaps are these.
  void expect_ends(Cause cause, double smallest, double largest) const {
    const CauseShare share = share_of(cause);
    EXPECT_NEAR(share.shorter, critical_gap() - smallest, solved);
    EXPECT_NEAR(share.longer, largest - critical_gap(), solved);
    EXPECT_GT(share.shorter, 1e-7);
  }
  /// Constants of the case with two fitted ones of the skin, of which the localisation has no effect here:
  /// the logarithm of the exchange time has a standard deviation, and a row was missed by so much (K).
  void fit(double deviation, double missed, double ignition_spread) {
    auto constants = std::make_shared<scene::Constants>(*input.scene.constants);
    constants->fitted_keys = {"friction.localisation", "gap.exchange_time"};
    constants->covariance = {0.04, 0.0, 0.0, deviation * deviation};
    constants->rows = {{"T at 18 ms", 0.0, 400.0, 400.0 + missed, "K", true}};
    const double trigger = skin().kinetics.ignition_temperature;
    constants->ignition_lowest = trigger - ignition_spread;
    constants->ignition_highest = trigger + ignition_spread;
    input.scene.constants = constants;
  }
};

TEST_F(Causes, InitialTemperatureWarmsTheAirToo) {
  const auto at = [&](double rise) {
    StudyCase other = input;
    other.scene.scene.initial_temperature += rise;
    surface::SkinModel model = surface::skin_model(other.scene.scene);
    model.surface.air = materials::warmed(skin().surface.air, rise);
    return critical_gap_of(model);
  };
  expect_ends(Cause::initial_temperature, at(12.0), at(-12.0));
}

/// The gap times the time is what counts.
TEST_F(Causes, PulseLengthStretchesTheLaunch) {
  expect_ends(Cause::pulse_length, critical_gap() / 1.05, critical_gap() * 1.05);
}

TEST_F(Causes, PeakPressureIsRaisedAndMirrored) {
  runs.push_back(finished(Part::raised, launch(1.04 * pressure)));
  expect_ends(Cause::peak_pressure, critical_gap_of(skin(), 1.04 * pressure),
              critical_gap_of(skin(), pressure / 1.04));
}

TEST_F(Causes, MeasuredCurveMayHaveLostAndMissedSomeOfItsPeak) {
  scene::Load& load = input.scene.scene.load;
  for (int i = 0; i <= 36; ++i) {
    load.curve_time.push_back(0.5e-3 * i);
    load.curve_pressure.push_back(496e6 * std::exp(-std::pow((0.5 * i - 9.2) / 3.0, 2.0)));
  }
  load.smoothing = 1e-3;
  const double pressure_ratio =
      (1.0 + scene::peak_missed_between_points(load)) / (1.0 - scene::peak_lost_to_smoothing(load));
  ASSERT_GT(pressure_ratio, 1.0);
  const double heat = std::pow(pressure_ratio, heat_exponent);
  expect_ends(Cause::measured_curve, critical_gap() / heat, critical_gap() * heat);
}

/// Two meshes of which one has cells twice as large differ by e - e/2^p, e being the error of the coarser.
TEST_F(Causes, NumericsExtrapolateTheDifferenceToACoarserCompanion) {
  ASSERT_EQ(companion_ratio(input.scene.scene), 2.0);
  runs.push_back(finished(Part::companion, launch_with_gap_times(1.1)));
  const double error = factor_of_safety * 0.1 * critical_gap() / (std::pow(2.0, order_of_cells) - 1.0);
  EXPECT_NEAR(share_of(Cause::numerics).shorter, error, 10 * solved);
  EXPECT_EQ(share_of(Cause::numerics).longer, share_of(Cause::numerics).shorter);
}

TEST_F(Causes, NumericsOfAFinerCompanionAreLargerAndAddTheCellsOfTheConstants) {
  input.scene.scene.numerics.cell_size = 2.5e-3;  // the constants were fitted on 1.25 mm
  ASSERT_EQ(companion_ratio(input.scene.scene), 0.5);
  runs.push_back(finished(Part::companion, launch_with_gap_times(0.95)));
  EXPECT_TRUE(std::isnan(share_of(Cause::numerics).shorter));
  runs.push_back(finished(Part::cells_of_constants, launch_with_gap_times(1.02)));
  const double refined = std::pow(2.0, order_of_cells);
  const double error = factor_of_safety * 0.05 * critical_gap() * refined / (refined - 1.0);
  EXPECT_NEAR(share_of(Cause::numerics).shorter, error + 0.02 * critical_gap(), 10 * solved);
}

TEST_F(Causes, NumericsAreNeverZero) {
  runs.push_back(finished(Part::companion, launch()));
  EXPECT_GE(share_of(Cause::numerics).shorter, gap_accuracy);
  EXPECT_GE(share_of(Cause::numerics).longer, gap_accuracy);
}

TEST_F(Causes, StatedNumericsAreALengthByTheSlopeOfTheTemperature) {
  study.numerics = {2.0, "a mesh study"};
  EXPECT_NEAR(share_of(Cause::numerics).shorter, length_of(2.0), 1e-5 * length_of(2.0));
  EXPECT_NEAR(share_of(Cause::numerics).longer, length_of(2.0), 1e-5 * length_of(2.0));
}

/// The critical gap grows with the exchange time; two standard deviations are factors of exp(0.2).
TEST_F(Causes, ConstantsReachTheEndsOfTheirFitAndOfTheIgnitionTemperature) {
  fit(0.1, 1.0, 3.0);
  const auto at_trigger = [&](double rise) {
    surface::SkinModel model = skin();
    model.kinetics.ignition_temperature += rise;
    return critical_gap_of(model);
  };
  const CauseShare share = share_of(Cause::constants);
  const double gap = critical_gap();
  EXPECT_NEAR(share.shorter, gap - at_trigger(-3.0) + gap * (1.0 - std::exp(-0.2)), 2 * solved);
  EXPECT_NEAR(share.longer, at_trigger(3.0) - gap + gap * (std::exp(0.2) - 1.0), 2 * solved);
}

TEST_F(Causes, ConstantsAreAtLeastTheLargestMisfit) {
  fit(1e-6, 5.0, 0.0);
  const CauseShare share = share_of(Cause::constants);
  EXPECT_NEAR(share.shorter, length_of(5.0), solved);
  EXPECT_NEAR(share.longer, length_of(5.0), solved);
}

/// From the gap on whose skin is, at the end of the launch, as hot as one that runs away; found here by
/// bisecting temperatures.
TEST_F(Causes, AfterLaunchIsTheGapFromWhichASkinRunsAway) {
  input = file.cases.front();  // with its reaction
  const surface::SkinModel model = skin();
  const trace::BottomTrace& trace = runs.front().result.mechanics.trace;
  const double critical = find_critical_gap(surface::IgnitionOfGaps(model, trace), 1e-3).value;
  const double limit = surface::runaway_temperature(model, model.initial_temperature);
  ASSERT_LT(limit, model.kinetics.ignition_temperature - 1.0);
  double cool = 0.0, hot = critical;
  while (hot - cool > 1e-9) {
    const double middle = 0.5 * (cool + hot);
    (surface::integrate_skin(model, trace, middle).temperature.back() < limit ? cool : hot) = middle;
  }
  const CauseShare share = share_of(Cause::after_launch, critical);
  EXPECT_NEAR(share.shorter, critical - hot, 2 * solved);
  EXPECT_GT(share.shorter, 1e-7);
  EXPECT_EQ(share.longer, 0.0);
}

TEST_F(Causes, OfALaunchThatDidNotCompleteAreNotKnown) {
  EXPECT_TRUE(std::isnan(share_of(Cause::peak_pressure).shorter));
  runs.push_back(finished(Part::raised, launch(1.04 * pressure)));
  runs.back().failure = "energy drift";
  EXPECT_TRUE(std::isnan(share_of(Cause::peak_pressure).shorter));
  EXPECT_NE(incomplete_launches(runs).find("energy drift"), std::string::npos);
}

TEST_F(Causes, AreThoseThatTheStudyDoesNotLeaveOut) {
  study.spreads = {0.0, 0.0, 0.0};
  std::vector<Cause> causes;
  for (const CauseShare& each : causes_of(study, input, runs, {CriticalGapKind::value, critical_gap()}))
    causes.push_back(each.cause);
  EXPECT_EQ(causes, (std::vector{Cause::numerics, Cause::constants, Cause::after_launch}));
  EXPECT_TRUE(causes_of(study, input, runs, {}).empty());
}

/// Half where cells twice as large would be fewer than two across a station.
TEST_F(Causes, CompanionHasCellsTwiceOrHalfAsLarge) {
  scene::Scene& scene = input.scene.scene;
  for (const auto& [cell, depth, ratio] : {std::tuple{1.25e-3, 5e-3, 2.0},
                                           {1.2501e-3, 5e-3, 0.5},
                                           {1.25e-3, 4.9e-3, 0.5},
                                           {1e-3, 4.9e-3, 2.0}}) {
    scene.numerics.cell_size = cell;
    scene.surface.station_depth = depth;
    EXPECT_EQ(companion_ratio(scene), ratio) << cell << ' ' << depth;
  }
}

}  // namespace
