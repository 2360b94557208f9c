// A wave in a law that was added as one file: the mechanics knows nothing of linear elasticity but its name.
#include "../../src/verify/mechanics_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe;
using materials::LinearElastic;
namespace mechanics = verify::mechanics;

/// Glass, about.
const LinearElastic glass{.density = 2500.0, .bulk = 40e9, .shear = 30e9};
/// sqrt((K + 4/3 G)/rho) of it: 80 GPa over 2500 kg/m3.
const double speed = std::sqrt(80e9 / 2500.0);

/// A strip of 1 m in a rigid barrel, where only the longitudinal wave can run, under a smooth pulse so weak
/// that densities change by 1e-6 at most.
scene::Scene strip(int cells, double peak_time) {
  scene::Scene scene = mechanics::block("glass", 1.0, 2.0 / cells, 1.0 / cells);
  scene.materials.push_back({"glass", glass});
  scene.symmetry = scene::Symmetry::plane_strain;
  scene.frame = scene::Frame::lab;
  scene.load = mechanics::pulse(1e4, peak_time);
  return scene;
}

/// Relative L2 error of the axial stress against d'Alembert, sigma = -p(t - (L - X)/c), when the front has
/// run 0.9 m.
double stress_error(int cells) {
  const double peak_time = 0.5 / speed;
  const scene::Scene scene = strip(cells, peak_time);
  mpm::Simulation simulation(scene);
  mechanics::run_to(simulation, 1.8 * peak_time);
  const scene::PressureHistory pressure(scene.load);
  const mpm::Body<LinearElastic>& body = simulation.bodies_of<LinearElastic>().at(0);
  const mpm::Lattice& lattice = body.particles.lattice;
  mechanics::RelativeError error;
  for (int i = 0; i < lattice.columns(); ++i) {
    const std::size_t slot = lattice.slot(i, 0);
    error.add(body.deviator(slot).xx - body.particles.pressure[slot],
              -pressure.at(simulation.time() - (1.0 - lattice.x_of(i)) / speed));
  }
  return error.value();
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
  const double measured = mechanics::speed_of_pulse(simulation, 0.6 * crossing, 0.9 * crossing);
  EXPECT_NEAR(measured, speed, 1e-4 * speed);
}

}  // namespace
