#include "launchsafe/study/accuracy_record.hpp"
#include "launchsafe/surface/skin.hpp"
#include "study/made_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

const std::vector<double> recorded_gaps{0.0, 4e-4};

/// What the record of a scene at some gaps (m) says of the own one, changed.
Coverage coverage_by(scene::Scene recorded, const std::vector<double>& gaps,
                     const std::function<void(scene::Scene&)>& change) {
  AccuracyRecord record;
  record.scene = std::move(recorded);
  record.scene.surface.gaps = gaps;
  find_bounds(record);
  scene::Scene scene = own_scene();
  change(scene);
  return coverage_of(record, scene);
}

Coverage coverage_of_changed(const std::function<void(scene::Scene&)>& change) {
  return coverage_by(own_scene(), recorded_gaps, change);
}

/// The scene's own load as a measured curve at some points.
void measure(scene::Load& load, int points) {
  const scene::PressureHistory history(load);
  std::vector<double> time, pressure;
  for (int i = 0; i < points; ++i) {
    time.push_back(scene::end_time(load) * i / (points - 1));
    pressure.push_back(history.at(time.back()));
  }
  load.curve_time = time;
  load.curve_pressure = pressure;
}

TEST(RecordedLaunch, CoversItselfAndAMeasuredCurveOfItsOwnShape) {
  for (const int points : {40, 200, 1000}) {
    const Coverage coverage =
        coverage_of_changed([points](scene::Scene& scene) { measure(scene.load, points); });
    EXPECT_EQ(coverage.reason, "") << points;
    EXPECT_NEAR(coverage.growth, 1.0, 1e-2) << points;
  }
  EXPECT_EQ(coverage_of_changed([](auto&) {}).growth, 1.0);
}

/// The rate at which compressed air heats a cold skin is that of the surface's own equation.
TEST(RecordedLaunch, AirHeatsAsItDoesInTheSkin) {
  const scene::Scene scene = own_scene();
  const double peak = 496e6, gap = 4e-4;
  const double air = materials::adiabatic_temperature(scene.surface.air, peak);
  const double expected = surface::heat_capacity_ratio(surface::skin_model(scene), gap) /
                          scene.surface.exchange_time * (air - scene.surface.air.initial_temperature);
  EXPECT_NEAR(gap * launch_of(scene).air_heating, expected, 1e-6 * expected);
}

TEST(RecordedLaunch, GrowsWithWhatDrivesTheErrorsAndNeverShrinks) {
  const auto growth = [](const std::function<void(scene::Scene&)>& change) {
    const Coverage coverage = coverage_of_changed(change);
    EXPECT_EQ(coverage.reason, "");
    return coverage.growth;
  };
  EXPECT_NEAR(growth([](auto& s) { s.load.peak *= 1.1; }), 1.21, 1e-9);
  EXPECT_NEAR(growth([](auto& s) { s.charge().strength.initial_crack_radius *= 2.0; }), std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(growth([](auto& s) { s.surface.localisation *= 1.5; }), 1.5, 1e-9);
  EXPECT_NEAR(growth([](auto& s) {
                s.load.peak *= 1.1;
                s.surface.localisation *= 1.5;
              }),
              1.815, 1e-9);
  for (const auto& smaller : std::vector<std::function<void(scene::Scene&)>>{
           [](auto& s) { s.load.peak *= 0.3; },
           [](auto& s) { s.charge().strength.initial_crack_radius = 0.0; },
           [](auto& s) { s.surface.localisation = 0.0; },
           [](auto& s) { s.charge().strength.flaw_size *= 10.0; },
           [](auto& s) { s.load.duration = 0.8 * scene::end_time(s.load); }})
    EXPECT_EQ(growth(smaller), 1.0);
}

TEST(RecordedLaunch, SaysNothingOfWhatTheRecordDoesNotHave) {
  const auto as_it_is = [](scene::Scene&) {};
  scene::Scene none = own_scene();
  none.charge().strength.initial_crack_radius = 0.0;
  EXPECT_NE(coverage_by(none, recorded_gaps, as_it_is).reason.find("without cracks"), std::string::npos);
  const Coverage no_gap = coverage_by(own_scene(), {0.0}, as_it_is);
  EXPECT_EQ(no_gap.largest_gap, 0.0);
  EXPECT_EQ(no_gap.growth, 1.0);
  none = own_scene();
  none.surface.localisation = 0.0;
  EXPECT_FALSE(coverage_by(none, recorded_gaps, as_it_is).reason.empty());
  const auto without_gap = [](scene::Scene& scene) { scene.surface.gaps = {0.0}; };
  EXPECT_EQ(coverage_by(own_scene(), recorded_gaps, without_gap).reason, "");
}

/// Three times the widest recorded gap, 0.04 cm, where the air heats as it did there; a sixth of that where
/// the exchange is six times as quick.
TEST(RecordedLaunch, CoversGapsUpToThreeTimesTheHeatOfTheAir) {
  const auto largest = [](double quicker) {
    return coverage_of_changed([=](scene::Scene& s) { s.surface.exchange_time /= quicker; }).largest_gap;
  };
  EXPECT_NEAR(largest(1.0), 1.2e-3, 1e-12);
  EXPECT_NEAR(largest(6.0), 2e-4, 1e-12);
}

TEST(RecordedLaunch, DoesNotCoverAnotherLoad) {
  const std::vector<std::function<void(scene::Load&)>> others{
      [](auto& load) { load.duration = 30e-3; }, [](auto& load) { load.peak_time = 6e-3; },
      [](auto& load) { load.steepness = 20; }, [](auto& load) { load.base = 0.3 * load.peak; },
      [](auto& load) {
        // The same pulse 4 ms later.
        const scene::PressureHistory history(load);
        scene::Load delayed = load;
        for (int i = 0; i <= 200; ++i) {
          const double time = scene::end_time(load) * i / 200;
          delayed.curve_time.push_back(time);
          delayed.curve_pressure.push_back(history.at(std::max(0.0, time - 4e-3)));
        }
        load = delayed;
      }};
  for (std::size_t i = 0; i < others.size(); ++i)
    EXPECT_FALSE(coverage_of_changed([&](scene::Scene& s) { others[i](s.load); }).reason.empty()) << i;
}

}  // namespace
