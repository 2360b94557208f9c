// States of rest, reached by dynamic relaxation, against closed forms.
#include "checks.hpp"
#include "mechanics_scenes.hpp"

#include <cmath>

namespace launchsafe::verify {
namespace mechanics {
namespace {

constexpr double bore = tube_bore, outside = tube_outside;

/// Least squares of y = a f(r) + b g(r).
struct TwoTerms {
  double a, b;
};
template <class F, class G>
TwoTerms fit(const std::vector<double>& r, const std::vector<double>& y, F&& f, G&& g) {
  double ff = 0.0, fg = 0.0, gg = 0.0, fy = 0.0, gy = 0.0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    ff += f(r[k]) * f(r[k]);
    fg += f(r[k]) * g(r[k]);
    gg += g(r[k]) * g(r[k]);
    fy += f(r[k]) * y[k];
    gy += g(r[k]) * y[k];
  }
  const double determinant = ff * gg - fg * fg;
  return {(fy * gg - gy * fg) / determinant, (gy * ff - fy * fg) / determinant};
}

}  // namespace

/// A short ring with free ends, where sigma_rr + sigma_tt is uniform: the stresses are Lame's, and plane
/// strain differs by a uniform axial strain only. The load is 0.1 MPa, where the laws are linear; results are
/// scaled to 100 MPa. It is a suction, so that the outer face moves into its cell: beyond a grid line it
/// would meet nodes of almost no mass, and the stress of the outermost particles would fall with time (an
/// error of the first order in the cell size). For the same reason the bore lies inside a cell and the ends
/// are left out.
Tube relaxed_tube(scene::Formulation formulation, int radial_cells) {
  constexpr double pressure = -1e5, scale = 100e6 / pressure;
  const double cell_size = outside / radial_cells;
  scene::Scene ring = block("steel", 8.0 * cell_size, outside, cell_size, formulation);
  ring.bodies[0].r_begin = bore;
  ring.frame = scene::Frame::lab;
  ring.barrel = scene::Barrel::none;
  ring.load = ramp(0.0, 1e-4, 1.0);
  ring.numerics.damping_time = 6.8e-6;  // critical for the breathing mode
  make_elastic(ring);
  mpm::Simulation simulation(ring);
  simulation.apply_bore_pressure(0, pressure);
  run_to(simulation, 3e-4);
  const mpm::Body<materials::Steel>& body = simulation.bodies_of<materials::Steel>()[0];
  const mpm::ParticleFields& p = body.particles;
  const int begin = 2, end = p.lattice.columns() - 3;  // clear of the ends
  std::vector<double> radius, hoop, displacement;
  for (int j = 0; j < p.lattice.rows(); ++j)
    for (int i = begin; i <= end; ++i) {
      const std::size_t slot = p.lattice.slot(i, j);
      radius.push_back(p.lattice.r_of(j));
      hoop.push_back(-body[materials::Steel::stress_rr][slot] - body[materials::Steel::stress_xx][slot] -
                     p.pressure[slot]);
      displacement.push_back(p.r[slot] - p.lattice.r_of(j));
    }
  const auto stress = fit(
      radius, hoop, [](double) { return 1.0; }, [](double r) { return 1.0 / (r * r); });
  const auto motion = fit(
      radius, displacement, [](double r) { return r; }, [](double r) { return 1.0 / r; });
  const double length = p.x[p.lattice.slot(end, 0)] - p.x[p.lattice.slot(begin, 0)];
  const double axial_strain = length / (p.lattice.x_of(end) - p.lattice.x_of(begin)) - 1.0;
  const auto& steel = ring.steel();
  const double bulk = bulk_modulus(steel), shear = steel.strength.shear_modulus;
  const double poisson = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
  return {scale * (stress.a + stress.b / (bore * bore)), scale * (stress.a + stress.b / (outside * outside)),
          scale * (motion.a * bore + motion.b / bore + poisson * axial_strain * bore)};
}

namespace {

Checks thick_walled_tube(scene::Formulation formulation) {
  using enum Tolerance;
  const std::string source = "Lame, 65/77.5 mm, plane strain";
  const double exact = 574.386e6;
  const Tube coarse = relaxed_tube(formulation, 29), fine = relaxed_tube(formulation, 116);
  return {{"hoop stress at the bore, 100 MPa inside", fine.hoop_bore / 1e6, 574.386, 5e-4, "MPa", source,
           relative},
          {"hoop stress outside", fine.hoop_outside / 1e6, 474.386, 5e-4, "MPa", source, relative},
          {"displacement of the bore", 1e3 * fine.displacement, 0.1769119, 5e-4, "mm", source, relative},
          {"order of convergence of the hoop stress at the bore, 5 to 20 cells in the wall",
           observed_order(std::abs(coarse.hoop_bore - exact), std::abs(fine.hoop_bore - exact), 4.0), 2.0,
           0.3, "", source}};
}

/// A column of charge under its own weight at the acceleration of the 155 mm shell. `expected`: MPa.
Checks setback_column(scene::Formulation formulation, scene::Symmetry symmetry, double expected) {
  constexpr double length = 0.56, cell = 5e-3;
  scene::Scene shell = shell_155(cell);
  shell.symmetry = symmetry;
  const double pressure = 1717.0 * length * scene::rigid_acceleration(shell, 496e6);
  scene::Scene column = block("charge", length, 2.0 * cell, cell, formulation);
  column.symmetry = symmetry;
  column.load = ramp(pressure, 1e-3, 1.0);
  column.numerics.damping_time = 3e-5;
  mpm::Simulation simulation(column);
  run_to(simulation, 3e-3);
  const mpm::Body<materials::Charge>& body = simulation.bodies_of<materials::Charge>()[0];
  const mpm::Lattice& lattice = body.particles.lattice;
  double worst = 0.0;
  for (int i = 0; i < lattice.columns(); ++i)
    worst = std::max(worst,
                     std::abs(-axial_stress(body, lattice.slot(i, 0)) / pressure - lattice.x_of(i) / length));
  const int last = lattice.columns() - 1;
  const double bottom = -axial_stress(body, lattice.slot(last, 0)) * length / lattice.x_of(last);
  return {{"axial pressure at the charge bottom", bottom / 1e6, expected, 1e-3, "MPa", "rho L a at 496 MPa",
           Tolerance::relative},
          {"largest deviation from rho a x along the column", worst, 0.0, 1e-3, "",
           "static equilibrium; of the bottom value"}};
}

}  // namespace
}  // namespace mechanics

std::vector<Computation> static_computations(scene::Formulation formulation) {
  using enum scene::Symmetry;
  return {
      {"thick-walled tube", [=] { return mechanics::thick_walled_tube(formulation); }},
      {"setback", [=] { return mechanics::setback_column(formulation, axisymmetric, 140.843); }},
      {"setback, plane strain",
       [=] { return mechanics::setback_column(formulation, plane_strain, 163.156); }},
  };
}

}  // namespace launchsafe::verify
