// Snapshots: which instants they are of, and what they hold beside the fields of the particles.
#include "launchsafe/run/case_result.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/quantity.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "run/burning_scenes.hpp"
#include "small_shell.hpp"
#include "store/same_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace launchsafe::run {
namespace {

using scene::Event;

/// A shell with smooth or rough faces, or bonded ones, whose skin ignites after some 0.2 ms.
scene::Scene shell(const std::string& more = "") {
  auto file = scene::caught([&] {
    return scene::parse_scene("constants = \"none\"\n" + testing::small_shell + testing::small_shell_base +
                                  more +
                                  "[load]\nduration = \"0.3 ms\"\npeak = \"200 MPa\"\n"
                                  "peak_time = \"0.2 ms\"\nexponent = 4\nshape = "
                                  "\"power-exponential\"\n[numerics]\ncell_size = \"2.5 mm\"\n"
                                  "[output]\ntrace_interval = \"5 us\"\n[gap]\nthickness = \"0, 0.04 cm\"\n"
                                  "exchange_time = \"0.02 ms\"\n",
                              "small.toml");
  });
  EXPECT_TRUE(file) << file.error().message();
  scene::Scene scene = file->scene;
  scene.charge().kinetics.ignition_temperature = 320.0;
  return scene;
}

const std::string sliding_faces =
    "[interface.wall]\ncondition = \"sliding\"\nfriction = 0.05\n"
    "[interface.base]\ncondition = \"sliding\"\nfriction = 0.05\n";

/// The snapshot of an event; one of no time where there is none.
Snapshot of(const std::vector<Snapshot>& snapshots, Event event) {
  for (const Snapshot& shot : snapshots)
    if (std::find(shot.events.begin(), shot.events.end(), event) != shot.events.end()) return shot;
  ADD_FAILURE() << "no snapshot of " << scene::word_of(event);
  return {};
}

MechanicsResult run_at(scene::Scene scene, std::vector<double> times) {
  scene.output.snapshot_events.clear();
  scene.output.snapshot_times = std::move(times);
  return run_mechanics(scene);
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

TEST(SnapshotsOfEvents, OfThePeakIsTheEndOfTheStepThatReachesIt) {
  scene::Scene scene = shell();
  scene.output.snapshot_events = {Event::peak_pressure};
  const MechanicsResult run = run_mechanics(scene);
  ASSERT_EQ(run.snapshots.size(), 1U);
  EXPECT_EQ(run.snapshots.front().events, std::vector{Event::peak_pressure});
  EXPECT_GE(run.snapshots.front().time, 2e-4);
  EXPECT_LT(run.snapshots.front().time, 2e-4 + 1.1 * scene::make_plan(scene).time_step);
}

// The launch that is computed again is bitwise the same.
TEST(SnapshotsOfEvents, OfIgnitionIsTheLaunchAtTheEarliestOfItsGaps) {
  for (const auto form : {scene::Formulation::total_lagrangian, scene::Formulation::updated_lagrangian}) {
    scene::Scene scene = shell();
    scene.numerics.formulation = form;
    scene.surface.gaps = {0.0, 4e-4, 6e-4};
    scene.output.snapshot_times = {1e-5};
    scene.output.snapshot_events = {Event::ignition};
    const CaseResult result = run_case(scene);
    ASSERT_TRUE(result.gaps[1].skin.ignition && result.gaps[2].skin.ignition);
    const double earliest = std::min(result.gaps[1].skin.ignition->time, result.gaps[2].skin.ignition->time);
    Snapshot shot = of(result.mechanics.snapshots, Event::ignition);
    EXPECT_GE(shot.time, earliest);
    ASSERT_EQ(shot.skins.size(), 3U);
    // It is at T2 from then on, but for the exchange until the next sample.
    EXPECT_NEAR(largest(shot.skins[2].temperature), scene.charge().kinetics.burnt_temperature, 1.0);
    const MechanicsResult direct = run_at(scene, {1e-5, earliest});
    ASSERT_EQ(direct.snapshots.size(), 2U);
    EXPECT_EQ(result.mechanics.trace.bottom_pressure, direct.trace.bottom_pressure);
    shot.events.clear();
    shot.skins.clear();
    testing::expect_same(shot, direct.snapshots[1]);
  }
}

TEST(SnapshotsOfEvents, ThatDoNotHappenAreNotThere) {
  scene::Scene scene = shell();
  scene.charge().kinetics.ignition_temperature = 500.0;
  scene.output.snapshot_events = {Event::peak_pressure, Event::ignition};
  const CaseResult result = run_case(scene);
  EXPECT_EQ(result.mechanics.snapshots.size(), 1U);
}

TEST(Snapshots, HoldTheSkinsOfAllGapsAlongTheBottom) {
  scene::Scene scene = shell();
  scene.output.snapshot_times = {0.0, 1.5e-4};
  const CaseResult result = run_case(scene);
  const trace::BottomTrace& trace = result.mechanics.trace;
  const auto stations = scene::stations_of(scene);
  ASSERT_EQ(result.mechanics.snapshots.size(), 2U);
  const Snapshot &rest = result.mechanics.snapshots[0], &loaded = result.mechanics.snapshots[1];
  ASSERT_EQ(rest.bottom_x.size(), 2 * stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    EXPECT_NEAR(rest.bottom_x[2 * i], 0.04, 1e-12);
    EXPECT_NEAR(rest.bottom_r[2 * i], stations[i].r_begin, 1e-12);
    EXPECT_NEAR(rest.bottom_r[2 * i + 1], stations[i].r_end, 1e-12);
  }
  // Stations are two cells wide here: where two meet, the bottom is half way between those of its cells.
  std::vector<std::size_t> row;  // cells at the bottom, from the axis outward
  for (std::size_t i = 0; i < rest.x.size(); ++i)
    if (rest.body[i] == 1 && rest.x[i] + rest.half_length_x[i] > 0.04 - 1e-9) row.push_back(i);
  ASSERT_EQ(row.size(), 2 * stations.size());
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const std::size_t outside = row[row.size() - 2 * i - 2], inside = row[row.size() - 2 * i - 3];
    EXPECT_NEAR(loaded.bottom_x[2 * i],
                0.5 * (loaded.x[outside] + loaded.half_length_x[outside] + loaded.x[inside] +
                       loaded.half_length_x[inside]),
                1e-12);
    EXPECT_EQ(loaded.bottom_x[2 * i], loaded.bottom_x[2 * i + 3]) << "the end of the next one inwards";
    EXPECT_EQ(loaded.bottom_r[2 * i], loaded.bottom_r[2 * i + 3]);
    EXPECT_NE(loaded.bottom_x[2 * i], 0.04);
  }
  ASSERT_EQ(loaded.skins.size(), result.gaps.size());
  for (std::size_t gap = 0; gap < result.gaps.size(); ++gap) {
    ASSERT_EQ(loaded.skins[gap].temperature.size(), stations.size());
    EXPECT_EQ(loaded.skins[gap].gap, result.gaps[gap].gap);
    EXPECT_TRUE(loaded.skins[gap].reaction_degree.empty());
    if (result.gaps[gap].skin.ignition) continue;
    for (std::size_t s = 0; s < stations.size(); ++s)
      EXPECT_EQ(loaded.skins[gap].temperature[s],
                surface::temperature_at_time(result.gaps[gap].skin, trace, s, loaded.time));
  }
}

// The base carries the charge: its contact pressure is the bottom's axial stress.
TEST(Snapshots, HoldSlipAndPressureOfFacesThatSlide) {
  scene::Scene scene = shell(sliding_faces);
  scene.output.snapshot_times = {1.5e-4, 3e-4};
  const MechanicsResult run = run_mechanics(scene);
  ASSERT_EQ(run.snapshots.size(), 2U);
  for (const Snapshot& shot : run.snapshots) {
    ASSERT_EQ(shot.faces.size(), run.interfaces.size());
    for (const FaceSnapshot& face : shot.faces) {
      ASSERT_FALSE(face.slip.empty());
      for (std::size_t k = 0; k < face.slip.size(); ++k) {
        EXPECT_GE(face.pressure[k], 0.0);
        EXPECT_GT(face.opening[k], -1e-9);
        EXPECT_LE(std::abs(face.shear[k]), 0.05 * face.pressure[k] * (1.0 + 1e-9) + 1e-3);
      }
    }
  }
  const auto base = std::find_if(run.interfaces.begin(), run.interfaces.end(),
                                 [](const InterfaceResult& each) { return each.body == "base"; });
  const auto index = static_cast<std::size_t>(base - run.interfaces.begin());
  const FaceSnapshot& bottom = run.snapshots[0].faces[index];
  double force = 0.0, area = 0.0;
  for (std::size_t k = 0; k + 1 < bottom.r.size(); ++k) {
    const double ring = bottom.r[k + 1] * bottom.r[k + 1] - bottom.r[k] * bottom.r[k];
    force += ring * 0.5 * (bottom.pressure[k] + bottom.pressure[k + 1]);
    area += ring;
  }
  const double pressure =
      trace::interpolate(run.trace.time, run.trace.bottom_pressure, run.snapshots[0].time);
  EXPECT_NEAR(force / area / pressure, 1.0, 0.05);
  EXPECT_EQ(run.snapshots[1].faces[index].body, "base");
}

TEST(Snapshots, OfAGapThatBurnsBeginWithItsIgnition) {
  scene::Scene scene = test_support::burning_column(1.25e-3, 2.5e-3, 1.5e-3);
  scene.surface.gaps = {0.0, 4e-4};
  scene.output.snapshot_times = {1e-4, 1e-3, 1.05e-3};
  scene.output.snapshot_events = {Event::ignition};
  const CaseResult result = run_case(scene);
  ASSERT_EQ(result.mechanics.snapshots.size(), 2U) << "the launch ends at 1 ms";
  for (const Snapshot& shot : result.mechanics.snapshots) EXPECT_TRUE(shot.burnt_share.empty());
  EXPECT_FALSE(result.gaps[0].combustion);
  ASSERT_TRUE(result.gaps[1].combustion);
  const CombustionHistory& burning = *result.gaps[1].combustion;
  const double ignition = result.gaps[1].skin.ignition->time;
  const Snapshot first = of(burning.snapshots, Event::ignition), &last = burning.snapshots.back();
  ASSERT_FALSE(first.skins.empty() || last.skins.empty());
  EXPECT_EQ(first.time, burning.snapshots.front().time);
  EXPECT_NEAR(first.time, ignition, 2e-6);
  EXPECT_NEAR(largest(last.skins.front().reaction_degree), 1.0, 1e-12);
  EXPECT_LT(largest(first.skins.front().reaction_degree), 0.1);
  EXPECT_GT(largest(last.burnt_share), largest(first.burnt_share));
  const auto late =
      std::find_if(burning.snapshots.begin(), burning.snapshots.end(),
                   [](const Snapshot& shot) { return shot.time >= 1e-3 && shot.events.empty(); });
  ASSERT_NE(late, burning.snapshots.end());
}

}  // namespace
}  // namespace launchsafe::run
