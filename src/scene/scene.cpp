#include "launchsafe/scene/scene.hpp"

#include "launchsafe/scene/load.hpp"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace launchsafe::scene {
namespace {

/// Area (m2) between two radii.
double cross_section(double r_begin, double r_end) {
  return std::numbers::pi * (r_end - r_begin) * (r_end + r_begin);
}

}  // namespace

std::vector<Material> usual_materials() {
  std::vector<Material> all;
  materials::for_each_law([&all]<class Law>(const Law& law) {
    all.push_back({std::string(Law::name), law});
  });
  return all;
}

void clear_remarks(Scene& scene) {
  scene.title.clear();
  for (Material& material : scene.materials) material.title.clear();
}

const Material* find_material(const Scene& scene, std::string_view name) {
  return keys::find_named(scene.materials, name);
}

const materials::Law& law_of(const Scene& scene, const Body& body) {
  const Material* material = find_material(scene, body.material);
  if (material == nullptr)
    throw std::invalid_argument("body \"" + body.name + "\" is of a material that the scene has not: \"" +
                                body.material + "\"");
  return material->law;
}

std::string material_text(const Scene& scene, const Body& body) {
  const Material* material = find_material(scene, body.material);
  if (material == nullptr || material->title.empty()) return body.material;
  return material->name + " (" + material->title + ")";
}

bool is_used(const Scene& scene, std::string_view material) {
  return std::ranges::find(scene.bodies, material, &Body::material) != scene.bodies.end();
}

std::vector<Material> used_materials(const Scene& scene) {
  std::vector<Material> used = scene.materials;
  std::erase_if(used, [&](const Material& material) { return !is_used(scene, material.name); });
  return used;
}

bool is_charge(const Scene& scene, const Body& body) { return is_explosive(law_of(scene, body)); }

bool has_charge(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [&](const Body& body) { return is_charge(scene, body); });
}

bool can_slide(const Interface& faces) { return faces.condition == Condition::sliding; }

std::vector<Interface> sliding_interfaces(const Scene& scene) {
  std::vector<Interface> sliding = scene.interfaces;
  std::erase_if(sliding, std::not_fn(can_slide));
  std::ranges::sort(sliding, {}, &Interface::body);
  return sliding;
}

const Interface* interface_between(const Scene& scene, std::size_t a, std::size_t b) {
  const auto speaks_of = [&](const Interface& faces, const Body& body, const Body& other) {
    if (faces.body != body.name) return false;
    return faces.against.empty() ? is_charge(scene, other) : faces.against == other.name;
  };
  const Body &one = scene.bodies[a], &two = scene.bodies[b];
  for (const Interface& faces : scene.interfaces)
    if (speaks_of(faces, one, two) || speaks_of(faces, two, one)) return &faces;
  return nullptr;
}

Extent extent_of(const Scene& scene) {
  return extent_where(scene, [](const Body&) { return true; });
}

Extent charge_extent(const Scene& scene) {
  return extent_where(scene, [&](const Body& body) { return is_charge(scene, body); });
}

Extent extent_where(const Scene& scene, const std::function<bool(const Body&)>& choose) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Extent extent{far, -far, far, -far};
  for (const Body& body : scene.bodies) {
    if (!choose(body)) continue;
    extent.x_begin = std::min(extent.x_begin, body.x_begin);
    extent.x_end = std::max(extent.x_end, body.x_end);
    extent.r_begin = std::min(extent.r_begin, body.r_begin);
    extent.r_end = std::max(extent.r_end, body.r_end);
  }
  return extent.x_end < extent.x_begin ? Extent{} : extent;
}

double length_tolerance(const Scene& scene) {
  const Extent all = extent_of(scene);
  return 1e-9 * std::max(all.x_end - all.x_begin, all.r_end);
}

double mass_of(const Scene& scene, std::string_view material) {
  double volume = 0.0;
  for (const Body& body : scene.bodies)
    if (body.material == material)
      volume += cross_section(body.r_begin, body.r_end) * (body.x_end - body.x_begin);
  const Material* of = find_material(scene, material);
  return of ? volume * initial_density(of->law) : 0.0;
}

double total_mass(const Scene& scene) {
  double mass = 0.0;
  for (const Material& material : scene.materials) mass += mass_of(scene, material.name);
  return mass;
}

double base_area(const Scene& scene) {
  double area = 0.0;
  for (const ChamberFace& face : chamber_of(scene).faces)
    if (face.across_x()) area -= face.direction() * cross_section(face.begin, face.end);
  return area;
}

double rigid_acceleration(const Scene& scene, double pressure) {
  return pressure * base_area(scene) / total_mass(scene);
}

RigidMotion rigid_motion(const Scene& scene, double time) {
  const double acceleration = rigid_acceleration(scene, 1.0);
  RigidMotion motion = PressureHistory(scene.load).drive(time);
  motion.velocity *= acceleration;
  motion.travel *= acceleration;
  return motion;
}

std::string rigid_motion_text(const Scene& scene, double time) {
  const RigidMotion motion = rigid_motion(scene, time);
  return fmt::format("{:.4g} m/s after {:.3g} m of travel", motion.velocity, motion.travel);
}

std::string word_of(LoadShape shape) { return shape == LoadShape::bell ? "bell" : "power-exponential"; }

}  // namespace launchsafe::scene
