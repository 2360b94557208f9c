#include "launchsafe/mpm/particles.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace launchsafe::mpm {
namespace {

constexpr int width = static_cast<int>(math::pack_width);

int columns_in_subrow(const Lattice& lattice, int subrow) {
  return (lattice.columns - subrow + lattice.stride - 1) / lattice.stride;
}

int padded(int count) { return (count + width - 1) / width * width; }

Lattice make_lattice(const scene::Scene& scene, const scene::Body& body) {
  const scene::Mesh mesh = scene::fit_mesh(scene);
  const int per_cell = scene.numerics.particles_per_cell;
  const scene::ParticleCount count = scene::particles_of(mesh, body, per_cell);
  Lattice lattice;
  lattice.columns = count.nx;
  lattice.rows = count.nr;
  lattice.stride = per_cell;
  for (int subrow = 0; subrow < per_cell; ++subrow)
    lattice.padded_columns += padded(columns_in_subrow(lattice, subrow));
  lattice.x_begin = body.x_begin;
  lattice.r_begin = body.r_begin;
  lattice.spacing_x = (body.x_end - body.x_begin) / count.nx;
  lattice.spacing_r = (body.r_end - body.r_begin) / count.nr;
  return lattice;
}

Kinematics make_kinematics(const scene::Scene& scene, int index, double density) {
  const scene::Body& body = scene.bodies[static_cast<std::size_t>(index)];
  Kinematics p;
  p.lattice = make_lattice(scene, body);
  p.body = index;
  const Lattice& lattice = p.lattice;
  p.half_x = 0.5 * lattice.spacing_x;
  p.half_r = 0.5 * lattice.spacing_r;
  const std::size_t slots = lattice.slots();
  // Massless slots lie at the body's first corner, out of the way and finite.
  p.x.assign(slots, lattice.x_of(0));
  p.r.assign(slots, lattice.r_of(0));
  p.velocity_x.assign(slots, 0.0);
  p.velocity_r.assign(slots, 0.0);
  p.mass.assign(slots, 0.0);
  p.density.assign(slots, density);
  p.pressure.assign(slots, 0.0);
  p.temperature.assign(slots, scene.initial_temperature);
  for (int j = 0; j < lattice.rows; ++j)
    for (int i = 0; i < lattice.columns; ++i) {
      const std::size_t slot = lattice.slot(i, j);
      p.x[slot] = lattice.x_of(i);
      p.r[slot] = lattice.r_of(j);
      const double radial_weight = scene.symmetry == scene::Symmetry::axisymmetric ? p.r[slot] : 1.0;
      p.mass[slot] = density * radial_weight * lattice.spacing_x * lattice.spacing_r;
    }
  return p;
}

}  // namespace

std::size_t Lattice::slot(int i, int j) const {
  const int subrow = i % stride;
  int offset = 0;
  for (int s = 0; s < subrow; ++s) offset += padded(columns_in_subrow(*this, s));
  return static_cast<std::size_t>(j) * static_cast<std::size_t>(padded_columns) +
         static_cast<std::size_t>(offset + i / stride);
}

SteelBody make_steel_body(const scene::Scene& scene, int body) {
  SteelBody steel;
  steel.kinematics = make_kinematics(scene, body, scene.steel.eos.density);
  const std::size_t slots = steel.kinematics.lattice.slots();
  for (auto* field :
       {&steel.stress_rr, &steel.stress_xx, &steel.stress_rx, &steel.energy, &steel.plastic_strain})
    field->assign(slots, 0.0);
  steel.flow_stress.assign(
      slots, materials::johnson_cook_flow_stress(scene.steel.strength, 0.0, 0.0, scene.initial_temperature));
  return steel;
}

ChargeBody make_charge_body(const scene::Scene& scene, int body) {
  ChargeBody charge;
  charge.kinematics = make_kinematics(scene, body, scene.charge.eos.initial_density);
  const std::size_t slots = charge.kinematics.lattice.slots();
  for (auto& element : charge.elements)
    for (auto& component : element) component.assign(slots, 0.0);
  charge.crack_radius.assign(slots, scene.charge.cracks.initial_crack_radius);
  charge.energy.assign(slots, scene.charge.eos.initial_energy);
  for (auto& friction : charge.friction) friction.assign(slots, 0.0);
  return charge;
}

double mass_of(const Kinematics& particles, scene::Symmetry symmetry) {
  const auto row_length = static_cast<std::ptrdiff_t>(particles.lattice.padded_columns);
  double total = 0.0;  // row by row: adding many equal masses to one large sum loses digits
  for (auto row = particles.mass.begin(); row != particles.mass.end(); row += row_length)
    total += std::accumulate(row, row + row_length, 0.0);
  return symmetry == scene::Symmetry::axisymmetric ? 2.0 * std::numbers::pi * total : total;
}

math::Deviator<double> deviator(const ChargeBody& charge, std::size_t slot) {
  math::Deviator<double> total{};
  for (const auto& element : charge.elements)
    total = total + math::Deviator<double>{element[0][slot], element[1][slot], element[2][slot]};
  return total;
}

double axial_deviator(const ChargeBody& charge, std::size_t slot) {
  double total = 0.0;
  for (const auto& element : charge.elements) total += element[1][slot];
  return total;
}

}  // namespace launchsafe::mpm
