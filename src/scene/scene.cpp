#include "launchsafe/scene/scene.hpp"

// clang-format off
#include <math.h>  // Boost 1.74's pchip.hpp calls ::isnan without including it, so this comes first.
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

/// Straight lines through the points of a curve too short for a spline.
std::function<double(double)> straight_lines(std::vector<double> time, std::vector<double> pressure) {
  return [time = std::move(time), pressure = std::move(pressure)](double t) {
    const auto after = std::upper_bound(time.begin(), time.end() - 1, t);
    const auto i = static_cast<std::size_t>(after - time.begin());
    const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
    return pressure[i - 1] + share * (pressure[i] - pressure[i - 1]);
  };
}

std::function<double(double)> interpolant(std::vector<double> time, std::vector<double> pressure) {
  if (time.size() < 4) return straight_lines(std::move(time), std::move(pressure));
  return boost::math::interpolators::pchip<std::vector<double>>(std::move(time), std::move(pressure));
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

PressureHistory::PressureHistory(const Load& load) : load_(load) {
  if (load_.curve_time.empty()) return;
  if (load_.curve_time.size() > 1) curve_ = interpolant(load_.curve_time, load_.curve_pressure);
  const double measured = *std::max_element(load_.curve_pressure.begin(), load_.curve_pressure.end());
  if (load_.rescale_to_peak && measured > 0.0) scale_ = load_.peak / measured;
}

double PressureHistory::at(double time) const {
  if (load_.curve_time.empty()) {
    if (time <= 0.0) return load_.base;
    const double ratio = time / load_.peak_time;
    return load_.base +
           (load_.peak - load_.base) * std::exp(load_.exponent * (std::log(ratio) + 1.0 - ratio));
  }
  if (time <= load_.curve_time.front() || !curve_) return scale_ * load_.curve_pressure.front();
  if (time >= load_.curve_time.back()) return scale_ * load_.curve_pressure.back();
  return scale_ * curve_(time);
}

double PressureHistory::peak() const {
  if (load_.curve_time.empty()) return at(std::min(load_.peak_time, load_.duration));
  double largest = std::max(at(0.0), at(load_.duration));
  for (const double time : load_.curve_time) {
    if (time >= 0.0 && time <= load_.duration) largest = std::max(largest, at(time));
  }
  return largest;
}

double PressureHistory::stated_peak() const {
  if (load_.curve_pressure.empty()) return load_.peak;
  return scale_ * *std::max_element(load_.curve_pressure.begin(), load_.curve_pressure.end());
}

}  // namespace launchsafe::scene
