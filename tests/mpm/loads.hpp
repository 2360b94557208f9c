// Loads that no scene asks for: forces that are put on the nodes before every step.
#pragma once

#include "launchsafe/mpm/simulation.hpp"

#include <cmath>
#include <vector>

namespace launchsafe::test_support {

/// A computation with steady body forces on single bodies, in the total-Lagrangian form.
class LoadedSimulation : public mpm::Simulation {
 public:
  using Simulation::Simulation;

  /// Adds a force, in m/s2 of the true mass, on a body (index into Scene::bodies) from now on.
  void apply_body_force(std::size_t body, double along, double across) {
    forces_.resize(bodies().size());
    forces_[body].along += along;
    forces_[body].across += across;
  }

  void step(double dt) {
    work_before_ = work_;
    for_each_node([](mpm::Nodes& n, int row, std::size_t node, const Force& force) {
      n.written(row).force_x[node] += force.along * n.mass[node];
      n.written(row).force_r[node] += force.across * n.mass[node];
    });
    Simulation::step(dt);
    const double mean = velocity_of_all();
    for_each_node([&](const mpm::Nodes& n, int, std::size_t node, const Force& force) {
      work_ +=
          dt * n.mass[node] * (force.along * (n.velocity_x[node] - mean) + force.across * n.velocity_r[node]);
    });
  }

  /// With the work of these forces, as all of it is: relative to the mass centre, at the begin of the last
  /// step.
  mpm::EnergyBalance energy() const {
    mpm::EnergyBalance energy = Simulation::energy();
    energy.external += work_before_;
    return energy;
  }

 private:
  struct Force {
    double along = 0, across = 0;
  };

  template <class F>
  void for_each_node(F&& f) {
    for (std::size_t body = 0; body < forces_.size(); ++body) {
      mpm::Nodes& n = total_lagrangian()->nodes()[body];
      for (int j = 0; j < n.rows; ++j)
        for (int i = 0; i < n.columns; ++i) f(n, j, n.index(i, j), forces_[body]);
    }
  }

  /// m/s along x, of the centre of the inertial masses.
  double velocity_of_all() const {
    double momentum = 0.0, inertia = 0.0;
    for (const mpm::Nodes& n : total_lagrangian()->nodes())
      for (std::size_t node = 0; node < n.mass.size(); ++node) {
        momentum += n.inertia_x[node] * n.velocity_x[node];
        inertia += n.inertia_x[node];
      }
    return momentum / inertia;
  }

  std::vector<Force> forces_;
  double work_ = 0, work_before_ = 0;
};

/// Puts a pressure (Pa) on the inner radial face of the first body for the next step, total-Lagrangian.
inline void press_bore(mpm::TotalLagrangian& form, const mpm::ParticleFields& p, double pressure) {
  mpm::Nodes& n = form.nodes()[0];
  const mpm::Lattice& lattice = p.lattice;
  for (int i = 0; i + 1 < n.columns; ++i) {
    const std::size_t node = n.index(i, 0);
    const double face = lattice.r_begin() + 0.5 * (n.displacement_r[node] + n.displacement_r[node + 1]);
    double length = 0.0;
    for (int part = 0; part < lattice.stride; ++part) length += lattice.length_x(i * lattice.stride + part);
    const double force = 0.5 * pressure * face * length;
    n.written(0).force_r[node] += force;
    n.written(0).force_r[node + 1] += force;
  }
}

/// Likewise of the background grid: cut by the linear hat functions in r at the face's present place and
/// weighted in x like its particles.
inline void press_bore(mpm::UpdatedLagrangian& form, const mpm::ParticleFields& p, double pressure) {
  mpm::Grid& grid = form.grid();
  const double half_x = 0.5 * p.lattice.length_x(0), half_r = 0.5 * p.lattice.length_r(0);
  const mpm::StencilContext context{grid, grid.origin_x, half_x, half_r};
  const auto nodes_x = static_cast<std::size_t>(grid.nodes_x);
  for (int i = 0; i < p.lattice.columns(); ++i) {
    const std::size_t slot = p.lattice.slot(i, 0);
    const mpm::Stencil stencil = stencil_of(context, math::Pack(p.x[slot]), math::Pack(p.r[slot]));
    if (stencil.inside.lanes[0] == 0) continue;
    const double face = p.r[slot] - half_r, coordinate = face / grid.dr + mpm::Grid::radial_padding;
    const double force = pressure * face * p.lattice.length_x(i);
    const double cell = std::floor(coordinate), share = coordinate - cell;
    const std::size_t column = static_cast<std::size_t>(stencil.first[0]) % nodes_x;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = static_cast<std::size_t>(cell) * nodes_x + column + k;
      grid.force_r[node] += force * (1.0 - share) * stencil.axial.value[k][0];
      grid.force_r[node + nodes_x] += force * share * stencil.axial.value[k][0];
    }
  }
}

/// In the formulation of the scene.
inline void press_bore(mpm::Simulation& simulation, double pressure) {
  const mpm::ParticleFields& p = mpm::particle_fields_of(simulation.bodies()[0]);
  if (mpm::TotalLagrangian* form = simulation.total_lagrangian())
    press_bore(*form, p, pressure);
  else
    press_bore(*simulation.updated_lagrangian(), p, pressure);
}

}  // namespace launchsafe::test_support
