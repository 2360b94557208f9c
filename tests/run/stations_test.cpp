// What stations read from particles whose state is made by hand.
#include "../../src/run/charge_heat.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

namespace launchsafe::run {
namespace {

constexpr double bottom_pressure = 100e6;  // Pa

scene::Scene scene_with(double cell_size) {
  const auto file =
      scene::caught([&] { return scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml"); });
  EXPECT_TRUE(file);
  scene::Scene scene = file->scene;
  scene.numerics.growth_x = 1.0;
  scene.numerics.cell_size = cell_size;
  scene.numerics.growth_r = 1.0;
  return scene;
}

/// Literal friction (J/m3) of a step by station, for a strain increment e_rx(x, r) of the charge.
std::vector<double> heat_of(const scene::Scene& scene, const std::function<double(double, double)>& strain) {
  mpm::Simulation simulation(scene);
  TraceRecorder recorder(simulation, scene);
  mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  for (int j = 0; j < p.lattice.rows(); ++j)
    for (int i = 0; i < p.lattice.columns(); ++i) {
      const std::size_t slot = p.lattice.slot(i, j);
      p.pressure[slot] = bottom_pressure;
      p.strain_change[2][slot] = strain(p.lattice.x_of(i), p.lattice.r_of(j));
    }
  recorder.accumulate(simulation, 1e-7);
  std::vector<double> heat;
  for (std::size_t k = 0; k < recorder.trace().stations.size(); ++k)
    if (!recorder.trace().stations[k].observation) heat.push_back(recorder.friction(k));
  return heat;
}

/// mu_d p sqrt(2/3 e:e) of a shear e_rx.
double heat_of_shear(const scene::Scene& scene, double shear) {
  return scene.charge().sliding_friction * bottom_pressure * std::sqrt(4.0 / 3.0) * std::abs(shear);
}

TEST(StationReadings, HaveTheAreaOfTheBottom) {
  const scene::Scene scene = scene_with(2.5e-3);
  mpm::Simulation simulation(scene);
  TraceRecorder recorder(simulation, scene);
  double area = 0.0;
  for (const trace::Station& station : recorder.trace().stations) area += station.area;
  EXPECT_NEAR(area, std::numbers::pi * 0.065 * 0.065, 1e-12);
}

TEST(StationReadings, OfAnEvenStrainAreItsHeatWhetherCellsFitOrNot) {
  for (const double cell : {2.5e-3, 1.9e-3, 0.7e-2}) {
    const scene::Scene scene = scene_with(cell);
    for (const double heat : heat_of(scene, [](double, double) { return 1e-5; }))
      EXPECT_NEAR(heat / heat_of_shear(scene, 1e-5), 1.0, 1e-12) << cell;
  }
}

// Mean of r over a ring by its volume: 2/3 (b^3 - a^3)/(b^2 - a^2); by cells it errs in second order.
TEST(StationReadings, AreMeansByVolume) {
  const scene::Scene scene = scene_with(1.25e-3);
  const auto heat = heat_of(scene, [](double x, double r) { return 1e-3 * r + 2e-3 * (0.678 - x); });
  const auto stations = scene::stations_of(scene);
  ASSERT_EQ(heat.size(), stations.size());
  for (std::size_t k = 0; k < heat.size(); ++k) {
    const double a = stations[k].r_begin, b = stations[k].r_end;
    const double mean = 1e-3 * 2.0 / 3.0 * (b * b * b - a * a * a) / (b * b - a * a) + 2e-3 * 2.5e-3;
    EXPECT_NEAR(heat[k] / heat_of_shear(scene, mean), 1.0, 0.01) << stations[k].name;
  }
}

// The norm is that of the mean, not the mean of norms: strains of neighbours that cancel heat nothing.
TEST(StationReadings, AverageTensorsBeforeTheirNorm) {
  const scene::Scene scene = scene_with(2.5e-3);
  for (const double heat : heat_of(scene, [](double x, double) { return x > 0.6755 ? 1e-5 : -1e-5; }))
    EXPECT_NEAR(heat / heat_of_shear(scene, 1e-5), 0.0, 1e-9);
}

TEST(StationReadings, NotANumberInOneParticleOfAStationIsNone) {
  const scene::Scene scene = scene_with(2.5e-3);
  const auto heat =
      heat_of(scene, [](double x, double r) { return x > 0.6755 && r > 0.0625 ? std::nan("") : 1e-5; });
  EXPECT_TRUE(std::isnan(heat.front()));
  EXPECT_TRUE(std::isfinite(heat.back()));
}

}  // namespace
}  // namespace launchsafe::run
