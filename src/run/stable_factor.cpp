#include "launchsafe/run/stable_factor.hpp"

#include "launchsafe/scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace launchsafe::run {
namespace {

/// Upper bound of sum G^2/S over the nodes of one direction, 1/m2.
double stiffness(double cell, double half) { return 2.0 / (cell * half) + 1.0 / (cell * (cell - half)); }

/// The total-Lagrangian bound: weights are constants of the lattice, so the sums are known.
double proved_on_lattice(const scene::Scene& scene) {
  const bool axisymmetric = scene.symmetry == scene::Symmetry::axisymmetric;
  const int per_cell = scene.numerics.particles_per_cell;
  // sum G^2/S = (1/S0 + 1/S1)/L^2 along one direction; largest for the particle nearest to a cell's edge.
  const double nearest = 0.5 / per_cell;
  const double along_x = 1.0 / nearest + 1.0 / (1.0 - nearest);
  double along_r = along_x;
  for (const scene::Body& body : scene.bodies) {
    const std::vector<double> edges = scene::particle_edges(scene, body).r;
    for (std::size_t j = 0; axisymmetric && j + 1 < edges.size(); ++j) {
      const double inner = edges[j - j % static_cast<std::size_t>(per_cell)];
      const double r = 0.5 * (edges[j] + edges[j + 1]), length = edges[j + 1] - edges[j];
      const double outer_share = (r - inner + length * length / (12.0 * r)) / (length * per_cell);
      along_r = std::max(along_r, 1.0 / outer_share + 1.0 / (1.0 - outer_share));
    }
  }
  return 2.0 / std::sqrt(along_x + along_r);
}

}  // namespace

double proved_time_step_factor(const scene::Scene& scene) {
  if (scene.numerics.formulation == scene::Formulation::total_lagrangian) return proved_on_lattice(scene);
  const scene::Mesh mesh = scene::fit_mesh(scene);
  double least = std::numeric_limits<double>::infinity();
  for (const scene::Body& body : scene.bodies) {
    const scene::ParticleCount count = scene::particles_of(scene, body);
    const double half_x = 0.5 * (body.x_end - body.x_begin) / count.nx;
    const double half_r = 0.5 * (body.r_end - body.r_begin) / count.nr;
    const double fastest = std::sqrt(stiffness(mesh.dx, half_x) + stiffness(mesh.dr, half_r));
    least = std::min(least, 2.0 / (fastest * std::min(mesh.dx, mesh.dr)));
  }
  return least;
}

std::string step_remark(const scene::Scene& scene) {
  const double factor = scene.numerics.time_step_factor, proved = proved_time_step_factor(scene);
  if (!(factor > proved)) return {};
  return fmt::format(
      "; the time step factor {:.3g} is above {:.3g}, up to which steps are proved stable for these "
      "particles",
      factor, proved);
}

}  // namespace launchsafe::run
