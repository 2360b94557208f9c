// Elastic wave in a bar with free sides and a free far end.
//
// A pressure pulse enters the bar at x = L, runs through it as compression, is reflected at the free
// end x = 0 as tension, and comes back. The program prints the axial stress at the middle against time,
// computed and after d'Alembert, as CSV.
#include "launchsafe/mpm/simulation.hpp"

#include <cmath>
#include <cstdio>

namespace {

using namespace launchsafe;
using materials::LinearElastic;

constexpr double length = 1.0, radius = 5e-3;  // m
constexpr double cell_size = 2.5e-3;           // m; 400 cells along the bar, 2 across
constexpr double peak = 1e5;         // Pa; strains of 1e-6, so that the closed form's linearity holds
constexpr double peak_time = 1e-4;   // s; the pulse is then some 0.6 m long, far longer than the bar is thick
constexpr double end_time = 4.5e-4;  // s; until the reflected pulse has passed the middle
constexpr int steps_per_line = 20;   // of the table that is printed

scene::Scene bar_scene(const LinearElastic& glass) {
  scene::Scene scene;
  scene.materials.push_back({"glass", glass});
  scene.bodies = {{"bar", "glass", 0.0, length, 0.0, radius}};  // x from 0 to L, r from 0 to the radius
  scene.barrel = scene::Barrel::none;                           // sides are free
  scene.numerics.cell_size = cell_size;
  // The pressure acts on the face at the largest x: it rises from `base` to `peak` and falls again.
  scene.load.base = 0.0;
  scene.load.peak = peak;
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.peak_time = peak_time;
  scene.load.duration = end_time;
  return scene;
}

/// Axial stress (Pa, tension positive) at x (m) and a time (s) after d'Alembert: the pulse that travels from
/// x = L towards the nose, and its reflection there, with the opposite sign.
double closed_form(const scene::PressureHistory& pressure, double speed, double x, double time) {
  return pressure.at(time - (length + x) / speed) - pressure.at(time - (length - x) / speed);
}

}  // namespace

int main() {
  const LinearElastic glass{.density = 2500, .bulk = 40e9, .shear = 30e9};  // kg/m3, Pa, Pa
  const scene::Scene scene = bar_scene(glass);
  const scene::PressureHistory pressure(scene.load);
  const double young = 9.0 * glass.bulk * glass.shear / (3.0 * glass.bulk + glass.shear);  // Pa
  const double speed = std::sqrt(young / glass.density);  // m/s, of waves much longer than the bar is thick

  mpm::Simulation simulation(scene);
  // Bodies are arrays of particles. Column i of the lattice lies at x_of(i), row 0 next to the axis.
  const mpm::Body<LinearElastic>& bar = simulation.bodies_of<LinearElastic>().front();
  const mpm::Lattice& lattice = bar.particles.lattice;
  const int middle = lattice.columns() / 2;
  const std::size_t particle = lattice.slot(middle, 0);

  std::puts("time_s,stress_Pa,closed_form_Pa");
  for (int step = 0; simulation.time() < end_time; ++step) {
    simulation.step(simulation.stable_time_step());
    if (step % steps_per_line != 0) continue;
    // Stress is stored as a deviator, tension positive, and a pressure, compression positive.
    const double stress = bar.deviator(particle).xx - bar.particles.pressure[particle];
    std::printf("%.6e,%.6e,%.6e\n", simulation.time(), stress,
                closed_form(pressure, speed, lattice.x_of(middle), simulation.time()));
  }
}
