#include "launchsafe/run/stable_factor.hpp"

#include "launchsafe/scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::run {
namespace {

/// Upper bound of sum G^2/S over the nodes of one direction, 1/m2.
double stiffness(double cell, double half) { return 2.0 / (cell * half) + 1.0 / (cell * (cell - half)); }

}  // namespace

double proved_time_step_factor(const scene::Scene& scene) {
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
