// What resists forces: the inertia of particles, and the masses and inertia of nodes that follow.
#include "launchsafe/mpm/total_lagrangian.hpp"

namespace launchsafe::mpm {

/// Selective mass scaling (Olovsson, Simonsson & Unosson, IJNME 63 (2005) 1436, who scale elements likewise),
/// by direction: motion along x and along r whose own step in a cell would be shorter than the lengthened one
/// gets the inertia with which it is not. Rows that are thin in r hold back the step through motion along r,
/// where the shell is all but at rest; along x, where it is accelerated, shear between them allows twice
/// that.
void TotalLagrangian::lengthen_steps() {
  const double longer = scene_.numerics.selective_inertia;
  if (!(longer > 1.0)) return;
  double fastest = 0.0;
  for_each_cell([&fastest](ParticleFields& p, std::size_t slot, const CellRates& own) {
    fastest = std::max(fastest, std::max(own.stretch_x, own.stretch_r) * p.mass[slot] / p.inertia_x[slot]);
  });
  // The sum of both bounds that of the fastest mode (Irons & Treharne 1971).
  const double allowed = fastest / (longer * longer);
  for_each_cell([allowed](ParticleFields& p, std::size_t slot, const CellRates& own) {
    const double mass = p.mass[slot];
    p.inertia_x[slot] = std::max(p.inertia_x[slot], mass * (own.stretch_x + own.shear_x) / allowed);
    p.inertia_r[slot] = std::max(p.inertia_r[slot], mass * (own.stretch_r + own.shear_r) / allowed);
  });
}

template <class F>
void TotalLagrangian::for_each_cell(F&& f) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    ParticleFields& p = std::visit([](auto& body) -> ParticleFields& { return body.particles; }, bodies_[b]);
    const materials::Law law = scene::law_of(scene_, scene_.bodies[static_cast<std::size_t>(p.body)]);
    const double stretch = std::pow(scene::longitudinal_speed(law), 2),
                 shear = materials::shear_modulus(law) / materials::initial_density(law);
    for (int j = 0; j < p.lattice.rows(); ++j)
      for (int i = 0; i < p.lattice.columns(); ++i) {
        const double per_x = std::pow(
                         parts_[b].inverse_length[static_cast<std::size_t>(i / p.lattice.stride)], 2),
                     per_r = std::pow(parts_[b].rows[static_cast<std::size_t>(j)].inverse_length, 2);
        f(p, p.lattice.slot(i, j), CellRates{stretch * per_x, shear * per_r, stretch * per_r, shear * per_x});
      }
  }
}

void TotalLagrangian::sum_nodal_masses() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    Nodes& n = nodes_[b];
    const Part& part = parts_[b];
    const ParticleFields& p = particle_fields_of(bodies_[b]);
    const Lattice& lattice = p.lattice;
    for (int j = 0; j < lattice.rows(); ++j)
      for (int i = 0; i < lattice.columns(); ++i) {
        const RowWeights& w = part.rows[static_cast<std::size_t>(j)];
        const double right = ((i % lattice.stride) + 0.5) / lattice.stride;
        const std::size_t slot = lattice.slot(i, j);
        for (int k = 0; k < 2; ++k) {
          const std::size_t node = n.index(i / lattice.stride, w.cell_row + k);
          for (const auto& [sum, own] : {std::pair{&n.mass, p.mass[slot]},
                                         {&n.inertia_x, p.inertia_x[slot]},
                                         {&n.inertia_r, p.inertia_r[slot]}}) {
            (*sum)[node] += own * w.value[k] * (1.0 - right);
            (*sum)[node + 1] += own * w.value[k] * right;
          }
        }
      }
    for (std::size_t node = 0; node < n.mass.size(); ++node) {
      inertia_ += n.inertia_x[node];
      if (!(n.mass[node] > 0.0)) continue;
      n.inverse_inertia_x[node] = 1.0 / n.inertia_x[node];
      n.inverse_inertia_r[node] = 1.0 / n.inertia_r[node];
      n.mass_share[node] = n.mass[node] / n.inertia_x[node];
    }
  }
}

}  // namespace launchsafe::mpm
