#include "launchsafe/scene/scene.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace launchsafe::scene {
namespace {

Extent nothing_yet() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {far, -far, far, -far};
}

void enclose(Extent& extent, const Body& body) {
  extent.x_begin = std::min(extent.x_begin, body.x_begin);
  extent.x_end = std::max(extent.x_end, body.x_end);
  extent.r_begin = std::min(extent.r_begin, body.r_begin);
  extent.r_end = std::max(extent.r_end, body.r_end);
}

/// Area (m2) swept by the body's radial extent: a full ring, or a strip of 1 m depth.
double cross_section(const Body& body, Symmetry symmetry) {
  const double width = body.r_end - body.r_begin;
  if (symmetry == Symmetry::plane_strain) return width;
  return std::numbers::pi * width * (body.r_end + body.r_begin);
}

double density_of(const Scene& scene, BodyMaterial material) {
  return material == BodyMaterial::steel ? scene.steel.eos.density : scene.charge.eos.initial_density;
}

}  // namespace

Extent extent_of(const Scene& scene) {
  Extent extent = nothing_yet();
  for (const Body& body : scene.bodies) enclose(extent, body);
  return scene.bodies.empty() ? Extent{} : extent;
}

Extent extent_of(const Scene& scene, BodyMaterial material) {
  Extent extent = nothing_yet();
  for (const Body& body : scene.bodies) {
    if (body.material == material) enclose(extent, body);
  }
  return has_material(scene, material) ? extent : Extent{};
}

materials::Law law_of(const Scene& scene, const Body& body) {
  if (body.material == BodyMaterial::steel) return scene.steel;
  return scene.charge;
}

bool has_material(const Scene& scene, BodyMaterial material) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [material](const Body& body) { return body.material == material; });
}

double mass_of(const Scene& scene, BodyMaterial material) {
  double volume = 0.0;
  for (const Body& body : scene.bodies) {
    if (body.material != material) continue;
    volume += cross_section(body, scene.symmetry) * (body.x_end - body.x_begin);
  }
  return volume * density_of(scene, material);
}

double total_mass(const Scene& scene) {
  return mass_of(scene, BodyMaterial::steel) + mass_of(scene, BodyMaterial::charge);
}

double base_area(const Scene& scene) {
  const Extent all = extent_of(scene);
  const double tolerance = 1e-9 * (all.x_end - all.x_begin);
  double area = 0.0;
  for (const Body& body : scene.bodies) {
    if (body.x_end >= all.x_end - tolerance) area += cross_section(body, scene.symmetry);
  }
  return area;
}

double rigid_acceleration(const Scene& scene, double pressure) {
  return pressure * base_area(scene) / total_mass(scene);
}

}  // namespace launchsafe::scene
