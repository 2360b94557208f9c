// Launches in which the gap closes, against what model section 14 gives.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::run {
namespace {

/// With true inertia.
scene::Scene shipped() {
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  scene.numerics.selective_inertia = 1.0;
  return scene;
}

/// Without friction heat and reaction.
void take_heat_away(scene::Scene& scene) {
  scene.surface.friction = scene::FrictionClosure::none;
  materials::KineticsParameters& kinetics = scene.charge().kinetics;
  kinetics.frequency = 0.0;
  kinetics.ignition_temperature = kinetics.burnt_temperature = 1e9;
}

/// The earlier load.
scene::Load earlier_load(scene::Load load) {
  load.shape = scene::LoadShape::power_exponential;
  load.peak_time = 12.96e-3;
  load.exponent = 13.58;
  return load;
}

/// The one-dimensional launch of model section 14: a charge within a smooth wall, over a base that nothing
/// slows down, under a load (the earlier one, or that of the shipped scene) from when it accelerates the
/// shell by `release` (m/s2) on.
scene::Scene flying_column(double release, bool shipped_load = false) {
  constexpr double largest = 1.4648e5, peak = 496e6, heavy = 1e3, base_length = 0.062;  // m/s2, Pa, -, m
  scene::Scene scene = shipped();
  const scene::PressureHistory pressure(shipped_load ? scene.load : earlier_load(scene.load));
  const auto acceleration = [&](double time) { return pressure.at(time) * largest / peak; };
  double begin = 0.0;
  while (acceleration(begin) < release) begin += 1e-6;
  scene.materials.push_back(
      {"heavy",
       materials::LinearElastic{.density = 7830.0 * heavy, .bulk = 160e9 * heavy, .shear = 80e9 * heavy}});
  scene.bodies = {{"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"base", "heavy", 0.678, 0.678 + base_length, 0.0, 0.065}};
  scene.interfaces = {{.body = "base", .condition = scene::Condition::sliding, .friction = 0.0}};
  scene.output.observation_points.clear();
  scene.numerics.cell_size = 2.5e-3;
  scene.surface.station_width = 13e-3;
  scene.surface.model = scene::GapModel::closing;
  scene.surface.ideal_air = true;
  const double mass = 7830.0 * heavy * base_length + 1717.0 * 0.56;  // kg/m2
  scene::Load load;
  for (double time = 0.0; begin + time < (release > 0.0 ? begin + 4e-4 : 8e-3); time += 2e-5) {
    load.curve_time.push_back(time);
    load.curve_pressure.push_back(acceleration(begin + time) * mass);
  }
  load.duration = load.curve_time.back();
  scene.load = load;
  take_heat_away(scene);
  scene::settle_load(scene);
  return scene;
}

CaseResult close_gap(scene::Scene scene, double gap, scene::GapBase base, double roughness) {
  scene.surface.base = base;
  scene.surface.roughness = roughness;
  CaseResult result = run_with_skin(scene, gap);
  EXPECT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
  EXPECT_TRUE(result.gaps.front().closing.has_value());
  return result;
}

double rise_of(const CaseResult& result) { return result.gaps.front().at_stations.temperature - 300.0; }

using scene::GapBase;

TEST(ClosingGap, HeatsTheSurfaceAsAOneDimensionalTrialDid) {
  struct Row {
    double release, gap, roughness, conducting, insulated;  // m/s2, m, m, K, K
  };
  for (const Row& row : {Row{1e5, 4e-4, 1e-5, 35.0, 46.0}, Row{1e5, 1e-3, 1e-5, 108.0, 134.0},
                         Row{1e5, 4e-4, 1e-6, 93.0, 122.0}}) {
    const scene::Scene scene = flying_column(row.release);
    EXPECT_NEAR(rise_of(close_gap(scene, row.gap, GapBase::conducting, row.roughness)), row.conducting,
                0.05 * row.conducting)
        << row.gap;
    EXPECT_NEAR(rise_of(close_gap(scene, row.gap, GapBase::insulated, row.roughness)), row.insulated,
                0.05 * row.insulated)
        << row.gap;
  }
  // Of rises of 12 and 14 K, given to whole kelvins.
  EXPECT_NEAR(rise_of(close_gap(flying_column(1e5), 4e-4, GapBase::conducting, 3e-5)), 12.0, 1.0);
  EXPECT_NEAR(rise_of(close_gap(flying_column(1e5), 4e-4, GapBase::insulated, 3e-5)), 14.0, 1.0);
}

// The same under the load of the shipped scene, as a program apart from this one computed it before: a column
// of 448 linear elastic elements (1717 kg/m3, 2L/c = 0.384 ms) between a free rear and the floor, explicit
// steps of 25 ns, 64 cells of ideal air (gamma 1.4, conductivity by Sutherland's law) between 26 of charge
// and 24 of steel, implicit conduction at constant pressure and then an isentropic change. With half of all
// that it gives the same to 0.1 K, and under the earlier load 34.2 and 45.1 K (0.4 mm), 107.1 and 133.7 K (1
// mm). Speeds are not compared: the elastic base, which the load meets at once, rings by a L/c = 1.2 m/s
// about the motion of a rigid one.
TEST(ClosingGap, HeatsTheSurfaceUnderTheShippedLoadAsAnotherProgramDid) {
  struct Row {
    double release, gap, roughness, conducting, insulated;  // m/s2, m, m, K, K
  };
  for (const Row& row : {Row{5e4, 4e-4, 1e-5, 30.97, 42.53}, Row{1e5, 4e-4, 1e-5, 34.21, 45.10},
                         Row{1e5, 1e-3, 1e-5, 107.07, 133.65}, Row{1.4e5, 4e-4, 1e-5, 35.68, 46.26},
                         Row{1.4e5, 4e-4, 3e-5, 11.90, 14.20}}) {
    const scene::Scene scene = flying_column(row.release, true);
    EXPECT_NEAR(rise_of(close_gap(scene, row.gap, GapBase::conducting, row.roughness)), row.conducting,
                0.05 * row.conducting)
        << row.release << " " << row.gap;
    EXPECT_NEAR(rise_of(close_gap(scene, row.gap, GapBase::insulated, row.roughness)), row.insulated,
                0.05 * row.insulated)
        << row.release << " " << row.gap;
  }
}

TEST(ClosingGap, HeatsLittleWhereTheChargeIsFreeFromTheStart) {
  EXPECT_NEAR(rise_of(close_gap(flying_column(0.0), 4e-4, GapBase::conducting, 1e-5)), 4.0, 1.0);
  EXPECT_NEAR(rise_of(close_gap(flying_column(0.0), 4e-4, GapBase::insulated, 1e-5)), 9.0, 1.0);
}

TEST(ClosingGap, ClosesItsAccounts) {
  const CaseResult result = close_gap(flying_column(1e5), 1e-3, GapBase::conducting, 1e-5);
  const ClosingHistory& closing = *result.gaps.front().closing;
  EXPECT_GE(closing.smallest_opening, 1e-5 * (1.0 - 1e-3));
  EXPECT_NEAR(closing.approach_speed, 13.0, 0.05 * 13.0);
  EXPECT_LT(result.gaps.front().skin.energy_residual, 1e-6);
  const surface::FilmEnergy& energy = closing.energy;
  EXPECT_NEAR(energy.charge + energy.base + energy.gas, energy.work, 1e-6 * energy.work);
}

// An elastic charge that meets a rigid base at the speed v has there the pressure Z v, Z = rho c, which grows
// by Z a t while waves run through it (model section 14: 5.007 MPa s/m). That is of small strain: Z grows by
// 1 % at the contact, by 3 % until the end.
TEST(ClosingGap, PressesOnTheBaseByImpedanceTimesSpeed) {
  constexpr double impedance = 1717.0 * 2916.0, acceleration = 1e5, gap = 1e-3;  // Pa s/m, m/s2, m
  scene::Scene scene = flying_column(acceleration);
  scene.surface.air.initial_pressure = 100.0;
  scene.charge().strength.relaxation_rates.fill(0.0);
  scene.charge().strength.initial_crack_radius = 1e-9;
  // Ramped, so that the base does not ring.
  constexpr double full = acceleration * 7830e3 * 0.062;  // Pa: the base has that mass per area
  scene.load.curve_time = {0.0, 1e-4, 5e-4};
  scene.load.curve_pressure = {0.0, full, full};
  scene.load.duration = 5e-4;
  scene::settle_load(scene);
  const ClosingHistory closing = *close_gap(scene, gap, GapBase::insulated, 1e-6).gaps.front().closing;
  const scene::PressureHistory load(scene.load);
  double time = 0.0, speed = 0.0, path = 0.0;
  for (constexpr double dt = 1e-8; path < gap; time += dt) {
    speed += dt * acceleration * load.at(time) / full;
    path += dt * speed;
  }
  const double interval = 0.05 * scene::transit_time(scene);
  const double until_last = 5e-4 - time - interval;
  EXPECT_NEAR(closing.contact_time, time, 1e-3 * time);
  EXPECT_NEAR(closing.pressure_at_contact / (impedance * (speed + 0.5 * acceleration * interval)), 1.01,
              0.02);
  EXPECT_NEAR(closing.largest_pressure / (impedance * (speed + acceleration * until_last)), 1.03, 0.02);
  EXPECT_NEAR(closing.steepest_rise, closing.pressure_at_contact / interval, 0.02 * closing.steepest_rise);
}

/// The 155 mm shell on a mesh that runs in a second, on a base from which the charge can part.
scene::Scene parting_shell() {
  scene::Scene scene = shipped();
  scene.numerics.cell_size = 5e-3;
  scene.numerics.selective_inertia = 4.0;
  scene.interfaces.push_back({.body = "base", .condition = scene::Condition::sliding, .friction = 0.0});
  scene.surface.model = scene::GapModel::closing;
  scene.surface.base = GapBase::insulated;
  return scene;
}

TEST(ClosingGap, IsTheLaunchWithoutAGapWhereItIsAsThinAsItsRoughness) {
  scene::Scene none = parting_shell();
  none.surface.model = scene::GapModel::reservoir;
  none.surface.base = GapBase::conducting;
  const MechanicsResult mechanics = run_mechanics(none);
  const double without = evaluate_gap(none, mechanics.trace, 0.0).at_stations.temperature;
  const scene::Scene scene = parting_shell();
  EXPECT_NEAR(run_with_skin(scene, 1.01e-5).gaps.front().at_stations.temperature, without, 1.0);
  const CaseResult rough = run_with_skin(scene, 1e-5);
  EXPECT_FALSE(rough.gaps.front().closing.has_value());
  EXPECT_DOUBLE_EQ(rough.gaps.front().gap, 1e-5);
  EXPECT_NEAR(rough.gaps.front().at_stations.temperature, without, 0.1);
}

TEST(ClosingGap, KeepsTheEnergyOfTheLaunch) {
  const CaseResult result = run_with_skin(parting_shell(), 4e-4);
  ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
  EXPECT_LT(largest_energy_drift(result.mechanics), 1e-6);
}

TEST(ClosingGap, KeepsTheEnergyOfALaunchWhoseChargeIsLetGoAtOnce) {
  // All that wall and nose bore comes to the gap at once, the shell rings, and faces that meet make steps
  // twenty times shorter.
  for (const double release : {3e-3, 6e-3, 9e-3}) {
    scene::Scene scene = parting_shell();
    scene.surface.release = release;
    scene.surface.release_duration = 0.0;
    const CaseResult result = run_with_skin(scene, 1e-3);
    ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
    EXPECT_LT(largest_energy_drift(result.mechanics), 1e-6) << release;
  }
}

TEST(ClosingGap, HeatsAsMuchWhereAirFlowsAndAllOfItClosesAlike) {
  // A column in a smooth wall moves along x alone.
  scene::Scene scene = flying_column(1e5);
  const double trapped = rise_of(close_gap(scene, 4e-4, GapBase::insulated, 1e-5));
  scene.surface.air_flow = scene::AirFlow::common_pressure;
  EXPECT_NEAR(rise_of(close_gap(scene, 4e-4, GapBase::insulated, 1e-5)), trapped, 0.01 * trapped);
}

TEST(ClosingGap, KeepsTheEnergyOfTheLaunchAndOfAirThatFlows) {
  scene::Scene scene = parting_shell();
  scene.surface.air_flow = scene::AirFlow::common_pressure;
  const CaseResult result = run_with_skin(scene, 4e-4);
  ASSERT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
  EXPECT_LT(largest_energy_drift(result.mechanics), 1e-6);
  EXPECT_LT(result.gaps.front().skin.energy_residual, 1e-9);
}

TEST(ClosingGap, IsSettledInTheTurnsOfMotionAndHeatWhereAirFlowsAndFacesBounce) {
  // Without a cushion of air that stays, faces of 1 um bounce, and what an interval has wrong feeds that: 10
  // K with the exchange of a film of even heating.
  scene::Scene scene = parting_shell();
  scene.surface.air_flow = scene::AirFlow::common_pressure;
  scene.surface.roughness = 1e-6;
  const auto hottest = [&](double turns) {
    scene.surface.turns = turns;
    const CaseResult result = run_with_skin(scene, 6.25e-4);
    EXPECT_GT(result.gaps.front().closing->contacts, 2);
    return result.gaps.front().at_stations.temperature;
  };
  EXPECT_NEAR(hottest(1.0), hottest(2.5), 1.0);
}

TEST(ClosingGap, IsNotReadOffTheTraceOfAnotherLaunch) {
  const scene::Scene scene = parting_shell();
  const GapResult read = evaluate_gap(scene, run_mechanics(scene).trace, 4e-4);
  EXPECT_TRUE(std::isnan(read.at_stations.temperature));
  EXPECT_FALSE(read.skin.ignition.has_value());
}

TEST(ClosingGap, HotAndDenseAirHeatsLessThanAnIdealOne) {
  // Of what compression stores, molecules that vibrate take a part.
  scene::Scene scene = flying_column(1e5);
  const CaseResult ideal = close_gap(scene, 1e-3, GapBase::insulated, 1e-5);
  scene.surface.ideal_air = false;
  const CaseResult real = close_gap(scene, 1e-3, GapBase::insulated, 1e-5);
  EXPECT_LT(real.gaps.front().closing->largest_gas_temperature,
            ideal.gaps.front().closing->largest_gas_temperature - 100.0);
  EXPECT_LT(rise_of(real), 0.95 * rise_of(ideal));
  EXPECT_GT(rise_of(real), 0.8 * rise_of(ideal));
  EXPECT_LT(real.gaps.front().skin.energy_residual, 1e-9);
}

// Faces 1 um apart meet at once. A launch without a gap once ignored what held its charge, and had 402 K.
TEST(ClosingGap, OfNoWidthTendsToTheLaunchWithoutOneAlsoWhereTheChargeIsHeld) {
  scene::Scene scene = parting_shell();
  scene.numerics.cell_size = 2.5e-3;
  scene.surface.roughness = 1e-6;
  scene.surface.release = 7.68e-3;
  const double thin = run_with_skin(scene, 1.1e-6).gaps.front().at_stations.temperature;
  const double none = run_with_skin(scene, 0.0).gaps.front().at_stations.temperature;
  EXPECT_NEAR(none, thin, 1.0);
  EXPECT_GT(none, 450.0);
  EXPECT_NEAR(evaluate_gap(scene, run_mechanics(scene).trace, 0.0).at_stations.temperature, none, 0.1);
}

TEST(ClosingGap, HoldsTheChargeUntilItIsReleased) {
  scene::Scene scene = parting_shell();
  scene.surface.release = 9e-3;
  scene.surface.release_duration = 0.0;
  const CaseResult held = run_with_skin(scene, 1e-3);
  ASSERT_EQ(held.mechanics.status, RunStatus::completed) << held.mechanics.reason;
  const ClosingHistory& closing = *held.gaps.front().closing;
  EXPECT_GT(closing.contact_time, 9e-3);
  // It gives way as an elastic body meanwhile, and meets the base soon afterwards.
  for (std::size_t i = 0; i < closing.time.size() && closing.time[i] < 9e-3; ++i)
    EXPECT_GT(closing.opening[i], 0.5e-3) << closing.time[i];
  EXPECT_LT(closing.contact_time, 9.5e-3);
}

TEST(ClosingGap, RingsLessWhereTheChargeIsLetGoSlowly) {
  // What nose and wall bore comes to the base, which a charge on so thin a gap touches before: where it comes
  // at once it swings by as much, and over several periods of the slowest mode (4 L/c = 0.77 ms) by less.
  scene::Scene scene = parting_shell();
  scene.surface.release = 9e-3;
  const auto swing = [&](double duration) {
    scene.surface.release_duration = duration;
    const CaseResult result = run_with_skin(scene, 2e-5);
    EXPECT_EQ(result.mechanics.status, RunStatus::completed) << result.mechanics.reason;
    // Of the bottom's pressure about that of rho L a, of which a peak of 496 MPa makes 140.843 MPa.
    const trace::BottomTrace& trace = result.mechanics.trace;
    double largest = 0.0;
    for (std::size_t i = 0; i < trace.samples() && trace.time[i] < 16e-3; ++i)
      if (trace.time[i] > 9e-3 + duration)
        largest = std::max(
            largest, std::abs(trace.bottom_pressure[i] / trace.chamber_pressure[i] * 496.0 / 140.843 - 1.0));
    return largest;
  };
  const double at_once = swing(0.0), slowly = swing(3e-3);
  EXPECT_GT(at_once, 0.3);
  EXPECT_LT(slowly, 0.5 * at_once);
}

}  // namespace
}  // namespace launchsafe::run
