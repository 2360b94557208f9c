#include "launchsafe/scene/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace launchsafe::scene {
namespace {

bool has_charge(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& body) { return body.material == BodyMaterial::charge; });
}

}  // namespace

std::int64_t counted(double count) {
  return count < static_cast<double>(most_counted) ? static_cast<std::int64_t>(count) : most_counted;
}

int parts_of(double length, double part) {
  const double parts = std::ceil(length / part - 1e-9);
  assert(parts < std::numeric_limits<int>::max());
  return std::max(1, static_cast<int>(parts));
}

Mesh fit_mesh(const Scene& scene) {
  const Extent all = extent_of(scene);
  const Extent fitted = has_charge(scene) ? extent_of(scene, BodyMaterial::charge) : all;
  const double length = fitted.x_end - fitted.x_begin;
  Mesh mesh;
  mesh.dx = length / parts_of(length, scene.numerics.cell_size);
  mesh.dr = all.r_end / parts_of(all.r_end, scene.numerics.cell_size);
  mesh.x_anchor = fitted.x_end;
  mesh.radius = all.r_end;
  return mesh;
}

std::string charge_edges_off_grid(const Scene& scene) {
  const Mesh mesh = fit_mesh(scene);
  std::string edges;
  for (const Body& body : scene.bodies) {
    if (body.material != BodyMaterial::charge) continue;
    for (const double r : {body.r_begin, body.r_end}) {
      const double cells = r / mesh.dr;
      if (std::abs(cells - std::round(cells)) < 1e-6) continue;
      edges += fmt::format("{}r = {:.6g} cm at {:.2f} cells", edges.empty() ? "" : ", ", 100.0 * r, cells);
    }
  }
  return edges;
}

ParticleCount particles_of(const Mesh& mesh, const Body& body, int particles_per_cell) {
  return {parts_of((body.x_end - body.x_begin) * particles_per_cell, mesh.dx),
          parts_of((body.r_end - body.r_begin) * particles_per_cell, mesh.dr)};
}

std::int64_t particle_count(const Scene& scene) {
  if (scene.bodies.empty()) return 0;
  const Mesh mesh = fit_mesh(scene);
  std::int64_t total = 0;
  for (const Body& body : scene.bodies) {
    total += particles_of(mesh, body, scene.numerics.particles_per_cell).total();
  }
  return total;
}

}  // namespace launchsafe::scene
