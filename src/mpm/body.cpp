#include "launchsafe/mpm/body.hpp"

#include <numeric>

namespace launchsafe::mpm {
namespace {

constexpr int width = static_cast<int>(math::pack_width);

int columns_in_subrow(const Lattice& lattice, int subrow) {
  return (lattice.columns() - subrow + lattice.stride - 1) / lattice.stride;
}

int padded(int count) { return (count + width - 1) / width * width; }

Lattice make_lattice(const scene::Scene& scene, const scene::Body& body) {
  const scene::GridLines edges = scene::particle_edges(scene, body);
  Lattice lattice;
  lattice.x_edges = edges.x;
  lattice.r_edges = edges.r;
  lattice.stride = scene.numerics.particles_per_cell;
  for (int subrow = 0; subrow < lattice.stride; ++subrow)
    lattice.padded_columns += padded(columns_in_subrow(lattice, subrow));
  return lattice;
}

ParticleFields make_kinematics(const scene::Scene& scene, int index, double density) {
  ParticleFields p;
  const scene::Body& body = scene.bodies[static_cast<std::size_t>(index)];
  p.lattice = make_lattice(scene, body);
  const double inertial_factor = scene.numerics.inertial_scaling;
  p.body = index;
  const Lattice& lattice = p.lattice;
  const std::size_t slots = lattice.slots();
  // Massless slots lie at the body's first corner, out of the way and finite.
  p.x.assign(slots, lattice.x_of(0));
  p.r.assign(slots, lattice.r_of(0));
  p.velocity_x.assign(slots, 0.0);
  p.velocity_r.assign(slots, 0.0);
  p.mass.assign(slots, 0.0);
  p.inertia_x.assign(slots, 0.0);
  p.inertia_r.assign(slots, 0.0);
  p.volume_ratio.assign(slots, 1.0);
  p.pressure.assign(slots, 0.0);
  p.temperature.assign(slots, scene.initial_temperature);
  for (int j = 0; j < lattice.rows(); ++j)
    for (int i = 0; i < lattice.columns(); ++i) {
      const std::size_t slot = lattice.slot(i, j);
      p.x[slot] = lattice.x_of(i);
      p.r[slot] = lattice.r_of(j);
      p.mass[slot] = density * p.r[slot] * lattice.length_x(i) * lattice.length_r(j);
      p.inertia_x[slot] = p.inertia_r[slot] = inertial_factor * p.mass[slot];
    }
  return p;
}

template <class Law>
Body<Law> make_body_of(const Law& law, const scene::Scene& scene, int index) {
  Body<Law> body{
      law, typename Law::Integrator(law), make_kinematics(scene, index, law.initial_density()), {}};
  const auto start = law.initial_state(scene.initial_temperature);
  for (std::size_t f = 0; f < start.size(); ++f)
    body.state[f].assign(body.particles.lattice.slots(), start[f]);
  return body;
}

}  // namespace

std::size_t Lattice::slot(int i, int j) const {
  const int subrow = i % stride;
  int offset = 0;
  for (int s = 0; s < subrow; ++s) offset += padded(columns_in_subrow(*this, s));
  return static_cast<std::size_t>(j) * static_cast<std::size_t>(padded_columns) +
         static_cast<std::size_t>(offset + i / stride);
}

AnyBody make_body(const scene::Scene& scene, int body) {
  const materials::Law law = scene::law_of(scene, scene.bodies[static_cast<std::size_t>(body)]);
  return std::visit([&](const auto& each) -> AnyBody { return make_body_of(each, scene, body); }, law);
}

void record(ParticleFields& particles, std::size_t slot) {
  const std::size_t slots = particles.mass.size();
  if (particles.recorded.empty()) {
    particles.recorded.assign(slots / math::pack_width, 0);
    for (math::AlignedArray& component : particles.strain_change) component.assign(slots, 0.0);
  }
  particles.recorded[slot / math::pack_width] = 1;
}

const ParticleFields& particle_fields_of(const AnyBody& body) {
  return std::visit([](const auto& each) -> const ParticleFields& { return each.particles; }, body);
}

double mass_of(const ParticleFields& particles) {
  const auto row_length = static_cast<std::ptrdiff_t>(particles.lattice.padded_columns);
  double total = 0.0;  // row by row: adding many equal masses to one large sum loses digits
  for (auto row = particles.mass.begin(); row != particles.mass.end(); row += row_length)
    total += std::accumulate(row, row + row_length, 0.0);
  return 2.0 * std::numbers::pi * total;
}

}  // namespace launchsafe::mpm
