#include "launchsafe/run/model_version.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

namespace launchsafe::run {
namespace {

/// What the model of this version says of the shipped scene on a coarse mesh, computed by itself: no truth,
/// but a guard. Where this test fails and the change of numbers is meant, raise model_version, so that
/// results stored before are not taken for results of this model, and put the new numbers here.
struct Numbers {
  double bottom_pressure_5ms = 5630734.919, bottom_pressure_11ms = 119772614.6;  // Pa
  double friction_literal = 148174.8838;     // J/m3, first station at the end
  double friction_inelastic = 104956.8026;   // J/m3, last station at the end
  double maximum_temperature = 453.6410752;  // K, 0.03 cm
};
constexpr int version_of_numbers = 1;

TEST(ModelVersion, BelongsToTheseNumbers) {
  ASSERT_EQ(model_version, version_of_numbers);
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  scene.numerics.cell_size = 10e-3;
  scene.numerics.inertial_scaling = 16.0;
  const trace::BottomTrace bottom = run_mechanics(scene).trace;
  const Numbers numbers;
  // Compilers and processors round differently; a change of the model moves more than this.
  constexpr double share = 1e-6;
  const auto pressure = [&bottom](double t) {
    return trace::interpolate(bottom.time, bottom.bottom_pressure, t);
  };
  EXPECT_NEAR(pressure(5e-3), numbers.bottom_pressure_5ms, share * numbers.bottom_pressure_5ms);
  EXPECT_NEAR(pressure(11e-3), numbers.bottom_pressure_11ms, share * numbers.bottom_pressure_11ms);
  const std::size_t stations = bottom.stations.size(), size = bottom.friction[0].size();
  EXPECT_NEAR(bottom.friction[0][size - stations], numbers.friction_literal,
              share * numbers.friction_literal);
  EXPECT_NEAR(bottom.friction[1][size - 1], numbers.friction_inelastic, share * numbers.friction_inelastic);
  EXPECT_NEAR(evaluate_gap(scene, bottom, 3e-4).at_points.temperature, numbers.maximum_temperature,
              share * numbers.maximum_temperature);
}

}  // namespace
}  // namespace launchsafe::run
