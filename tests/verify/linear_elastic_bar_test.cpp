// A wave in a law that was added as one file: the mechanics knows nothing of linear elasticity but its name.
#include "launchsafe/mpm/simulation.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe;
using materials::LinearElastic;

/// Glass, about.
const LinearElastic glass{.density = 2500.0, .bulk = 40e9, .shear = 30e9};
/// sqrt((K + 4/3 G)/rho) of it: 80 GPa over 2500 kg/m3.
const double speed = std::sqrt(80e9 / 2500.0);

/// A strip of 1 m in a rigid barrel, where only the longitudinal wave can run, under a smooth pulse so weak
/// that densities change by 1e-6 at most.
scene::Scene strip(int cells, double peak_time) {
  scene::Scene scene;
  scene.materials.push_back({"glass", glass});
  scene.bodies = {{"strip", "glass", 0.0, 1.0, 0.0, 2.0 / cells}};
  scene.symmetry = scene::Symmetry::plane_strain;
  scene.frame = scene::Frame::lab;
  scene.numerics.cell_size = 1.0 / cells;
  scene.load.base = 0.0;
  scene.load.peak = 1e4;
  scene.load.peak_time = peak_time;
  scene.load.duration = 10.0 * peak_time;
  return scene;
}

void run_to(mpm::Simulation& simulation, double end) {
  const double begin = simulation.time();
  const int steps = static_cast<int>(std::ceil((end - begin) / simulation.stable_time_step()));
  for (int step = 0; step < steps; ++step) simulation.step((end - begin) / steps);
}

/// Relative L2 error of the axial stress against d'Alembert, sigma = -p(t - (L - X)/c), when the front has
/// run 0.9 m.
double stress_error(int cells) {
  const double peak_time = 0.5 / speed;
  const scene::Scene scene = strip(cells, peak_time);
  mpm::Simulation simulation(scene);
  run_to(simulation, 1.8 * peak_time);
  const scene::PressureHistory pressure(scene.load);
  const mpm::Body<LinearElastic>& body = simulation.bodies_of<LinearElastic>().at(0);
  double difference = 0.0, scale = 0.0;
  for (int i = 0; i < body.kinematics.lattice.columns(); ++i) {
    const std::size_t slot = body.kinematics.lattice.slot(i, 0);
    const double exact = -pressure.at(simulation.time() - (1.0 - body.kinematics.lattice.x_of(i)) / speed);
    const double computed = body.deviator(slot).xx - body.kinematics.pressure[slot];
    difference += (computed - exact) * (computed - exact);
    scale += exact * exact;
  }
  return std::sqrt(difference / scale);
}

/// m from the nose.
double centre_of_momentum(const mpm::Simulation& simulation) {
  double moment = 0.0, momentum = 0.0;
  simulation.for_each_body([&](const mpm::Kinematics& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i) {
      momentum += p.mass[i] * p.velocity_x[i];
      moment += p.mass[i] * p.velocity_x[i] * p.x[i];
    }
  });
  return moment / momentum;
}

TEST(LinearElasticBar, WavesApproachTheClosedFormAtSecondOrder) {
  const double coarse = stress_error(50), middle = stress_error(100), fine = stress_error(200);
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.1) << coarse << " " << middle;
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.1) << middle << " " << fine;
  EXPECT_LT(fine, 2e-3);
}

TEST(LinearElasticBar, PulsesRunAtTheLongitudinalSpeed) {
  const double crossing = 1.0 / speed;
  mpm::Simulation simulation(strip(200, 0.2 * crossing));
  run_to(simulation, 0.6 * crossing);
  const double from = centre_of_momentum(simulation);
  run_to(simulation, 0.9 * crossing);
  EXPECT_NEAR((from - centre_of_momentum(simulation)) / (0.3 * crossing), speed, 1e-4 * speed);
}

}  // namespace
