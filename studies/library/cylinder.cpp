// Thick-walled cylinder under internal pressure.
//
// A short cylinder with free ends is loaded in its bore and comes to rest under damping. The program prints
// radial and hoop stress and the radial displacement over the wall, computed and after Lame, as CSV.
#include "launchsafe/mpm/simulation.hpp"

#include <cmath>
#include <cstdio>

namespace {

using namespace launchsafe;
using materials::LinearElastic;

constexpr double bore = 0.05, outside = 0.1;  // radii, m
constexpr int cells_in_wall = 20;
constexpr double cell_size = (outside - bore) / cells_in_wall;  // m
constexpr double cylinder_length = 8.0 * cell_size;             // m
constexpr double bore_pressure = 1e6;  // Pa; strains of 1e-5, as Lame's solution is linear

double young_modulus(const LinearElastic& m) { return 9.0 * m.bulk * m.shear / (3.0 * m.bulk + m.shear); }

/// Stresses (Pa, tension positive) and radial displacement (m) in the wall.
struct Wall {
  double radial, hoop, displacement;
};

/// Lame's solution for free ends (plane stress) at a radius (m).
Wall closed_form(const LinearElastic& material, double r) {
  const double mean = bore_pressure * bore * bore / (outside * outside - bore * bore);
  const double varying = mean * outside * outside / (r * r);
  const double young = young_modulus(material), poisson = 0.5 * young / material.shear - 1.0;
  const double hoop_strain = ((1.0 - poisson) * mean + (1.0 + poisson) * varying) / young;
  return {mean - varying, mean + varying, r * hoop_strain};
}

scene::Scene cylinder_scene(const LinearElastic& steel) {
  scene::Scene scene;
  scene.materials.push_back({"cylinder steel", steel});
  scene.bodies = {{"cylinder", "cylinder steel", 0.0, cylinder_length, bore, outside}};
  scene.barrel = scene::Barrel::none;       // the outer face is free
  scene.load.base = scene.load.peak = 0.0;  // and so are the ends
  scene.numerics.cell_size = cell_size;
  // The cylinder breathes at about sqrt(E/rho) over its mean radius (rad/s). Velocities decay as
  // exp(-t/damping_time); 1/(2 frequency) is critical for that motion.
  const double frequency = std::sqrt(young_modulus(steel) / steel.density) / (0.5 * (bore + outside));
  scene.numerics.damping_time = 0.5 / frequency;
  return scene;
}

/// Puts the pressure in the bore on the nodes of the inner face, half of a cell's force on either of its two.
/// It acts in the next step.
void load_bore(mpm::Simulation& simulation) {
  mpm::Nodes& nodes = simulation.total_lagrangian()->nodes().front();
  for (int i = 0; i + 1 < nodes.columns; ++i)
    for (const int end : {i, i + 1})
      nodes.written(0).force_r[nodes.index(end, 0)] +=
          0.5 * bore_pressure * bore * cell_size;  // N per radian
}

}  // namespace

int main() {
  const LinearElastic steel{.density = 7830, .bulk = 166.4e9, .shear = 80e9};  // kg/m3, Pa, Pa
  const scene::Scene scene = cylinder_scene(steel);
  mpm::Simulation simulation(scene);
  const double end_time = 60.0 * scene.numerics.damping_time;  // s; what is left of the motion is exp(-30)
  while (simulation.time() < end_time) {
    load_bore(simulation);
    simulation.step(simulation.stable_time_step());
  }

  const mpm::Body<LinearElastic>& cylinder = simulation.bodies_of<LinearElastic>().front();
  const mpm::ParticleFields& particles = cylinder.particles;
  const int middle = particles.lattice.columns() / 2;  // the column half way between the ends
  std::puts(
      "radius_m,radial_Pa,radial_closed_form_Pa,hoop_Pa,hoop_closed_form_Pa,displacement_m,"
      "displacement_closed_form_m");
  for (int row = 0; row < particles.lattice.rows(); ++row) {
    const std::size_t slot = particles.lattice.slot(middle, row);
    const double radius = particles.lattice.r_of(row);  // at rest
    const auto deviator = cylinder.deviator(slot);
    const Wall exact = closed_form(steel, radius);
    std::printf("%.6e,%.6e,%.6e,%.6e,%.6e,%.6e,%.6e\n", radius, deviator.rr - particles.pressure[slot],
                exact.radial, deviator.tt() - particles.pressure[slot], exact.hoop,
                particles.r[slot] - radius, exact.displacement);
  }
}
