// Elastic waves against d'Alembert, in either formulation. Loads are small, so that the laws are linear, and
// numbers are scaled to 100 MPa where model section 10 gives them so.
#include "exact_solutions.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe;
using namespace launchsafe::test_support;

constexpr double weak_peak = 1e5;  // Pa

class Waves : public testing::TestWithParam<scene::Formulation> {};

INSTANTIATE_TEST_SUITE_P(Formulations, Waves, testing::ValuesIn(both_formulations),
                         [](const auto& test) { return name_of(test.param); });

TEST_P(Waves, ApproachDAlembertAtSecondOrder) {
  // uGIMP on smooth fields and the leapfrog are of second order.
  WaveError coarse = longitudinal_error(GetParam(), 50);
  for (const int cells : {100, 200, 400}) {
    const WaveError fine = longitudinal_error(GetParam(), cells);
    EXPECT_NEAR(std::log2(coarse.velocity / fine.velocity), 2.0, 0.1) << cells;
    EXPECT_NEAR(std::log2(coarse.stress / fine.stress), 2.0, 0.1) << cells;
    coarse = fine;
  }
  EXPECT_LT(coarse.stress, 5e-4);
}

scene::Scene free_bar(double length, const scene::Load& load, scene::Formulation formulation) {
  scene::Scene bar = block("steel", length, 0.005, 0.0025, formulation);
  bar.barrel = scene::Barrel::none;
  bar.load = load;
  return bar;
}

TEST_P(Waves, MoveAFreeBarAtThePressureOverItsImpedance) {
  const scene::Scene bar = free_bar(1.0, ramp(weak_peak, 1e-4), GetParam());
  mpm::Simulation simulation(bar);
  const double dt = run_to(simulation, 1.8e-4);
  const double of_frame = scene::rigid_motion(bar, simulation.time() - 0.5 * dt).velocity;
  const mpm::ParticleFields& p = simulation.bodies_of<materials::Steel>()[0].get().particles;
  double momentum = 0.0, mass = 0.0;  // over the section 0.1 to 0.2 m from the base
  for (std::size_t i = 0; i < p.mass.size(); ++i) {
    if (p.x[i] < 0.8 || p.x[i] > 0.9) continue;
    momentum += p.mass[i] * p.velocity_x[i];
    mass += p.mass[i];
  }
  // p/(rho c) with the bar speed, at 100 MPa.
  EXPECT_NEAR((of_frame - momentum / mass) * 100e6 / weak_peak / 2.484790, 1.0, 1e-3);
}

// ---- a law that was added as one file: the mechanics knows nothing of linear elasticity but its name ----

/// Glass, about.
const materials::LinearElastic glass{.density = 2500.0, .bulk = 40e9, .shear = 30e9};
/// sqrt((K + 4/3 G)/rho) of it: 80 GPa over 2500 kg/m3.
const double glass_speed = std::sqrt(80e9 / 2500.0);

/// A strip of 1 m in a rigid barrel, under a pulse so weak that densities change by 1e-6 at most.
scene::Scene glass_strip(int cells, double peak_time) {
  scene::Scene scene = block("glass", 1.0, 2.0 / cells, 1.0 / cells);
  scene.materials.push_back({"glass", glass});
  scene.load = pulse(1e4, peak_time);
  return scene;
}

/// Relative error of the axial stress, sigma = -p(t - (L - X)/c), when the front has run 0.9 m.
double glass_stress_error(int cells) {
  const double peak_time = 0.5 / glass_speed;
  const scene::Scene scene = glass_strip(cells, peak_time);
  mpm::Simulation simulation(scene);
  run_to(simulation, 1.8 * peak_time);
  const scene::PressureHistory pressure(scene.load);
  const mpm::Body<materials::LinearElastic>& body = simulation.bodies_of<materials::LinearElastic>().at(0);
  const mpm::Lattice& lattice = body.particles.lattice;
  RelativeError error;
  for (int i = 0; i < lattice.columns(); ++i)
    error.add(axial_stress(body, lattice.slot(i, 0)),
              -pressure.at(simulation.time() - (1.0 - lattice.x_of(i)) / glass_speed));
  return error.value();
}

TEST(LinearElasticBar, WavesApproachTheClosedFormAtSecondOrder) {
  const double coarse = glass_stress_error(50), middle = glass_stress_error(100),
               fine = glass_stress_error(200);
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.1) << coarse << " " << middle;
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.1) << middle << " " << fine;
  EXPECT_LT(fine, 2e-3);
}

}  // namespace
