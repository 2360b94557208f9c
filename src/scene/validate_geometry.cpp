#include "launchsafe/scene/load.hpp"
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// Of numerics.cell_size.
constexpr double least_distance = 0.1;

std::string centimetres(double length) {
  return fmt::format("{:.10g} cm", in_unit(length, Dimension::length, "cm"));
}
std::string exact_range(double begin, double end) {
  return fmt::format("{:.10g} to {}", in_unit(begin, Dimension::length, "cm"), centimetres(end));
}

/// Of a body that begins or ends near a place (m); `what` lies there.
InputError fault_of(const SceneFile& file, const Body& body, const Axis& along, double place,
                    const std::string& what) {
  return fault_at(file, fmt::format("body.{}.{}", body.name, along.name),
                  fmt::format("\"{}\", near {}, {}", exact_range(body.*along.begin, body.*along.end), what,
                              centimetres(place)),
                  fmt::format("that place, or one at least {} away: a tenth of numerics.cell_size",
                              length_text(least_distance * file.scene.numerics.cell_size)));
}

void check_pair(const SceneFile& file, const Body& body, const Body& other, const Axis& along) {
  const double tolerance = length_tolerance(file.scene),
               least = least_distance * file.scene.numerics.cell_size;
  for (const auto own : {along.begin, along.end})
    for (const auto others : {along.begin, along.end}) {
      const double place = other.*others, distance = std::abs(body.*own - place);
      if (distance <= tolerance || distance >= least - tolerance) continue;
      throw fault_of(file, body, along, place, fmt::format("an edge of the body \"{}\"", other.name));
    }
}

/// The length along r of the front or rear face of a charge that other bodies lie against, m.
double covered_length(const Scene& scene, const Body& charge, bool rear) {
  double length = 0.0;
  for (const Body& body : scene.bodies) {
    const double distance = rear ? body.x_begin - charge.x_end : body.x_end - charge.x_begin;
    if (std::abs(distance) <= length_tolerance(scene)) length += std::max(0.0, overlap(body, charge, axis_r));
  }
  return length;
}

InputError open_bottom(const SceneFile& file, const Body& charge) {
  return fault_at(
      file, "gap.thickness",
      fmt::format("a gap in the drawing: no body lies against all of the bottom of \"{}\", x = {}, r {}",
                  charge.name, centimetres(charge.x_end), exact_range(charge.r_begin, charge.r_end)),
      "a bottom that bears on a body all over; the gap is no part of the drawing, gap.thickness says it");
}

void check_ends(const SceneFile& file) {
  const Scene& scene = file.scene;
  const double tolerance = length_tolerance(scene), bottom = charge_extent(scene).x_end;
  for (const Body& charge : scene.bodies) {
    if (!is_charge(scene, charge)) continue;
    for (const bool rear : {true, false}) {
      const double width = charge.r_end - charge.r_begin, covered = covered_length(scene, charge, rear);
      if (covered >= width - tolerance * static_cast<double>(scene.bodies.size())) continue;
      if (rear && charge.x_end >= bottom - tolerance) throw open_bottom(file, charge);
      if (scene.open_charge) continue;
      throw fault_at(file, fmt::format("body.{}.x", charge.name),
                     fmt::format("\"{}\", where no body covers the {} of the charge, r {}, all over",
                                 exact_range(charge.x_begin, charge.x_end), rear ? "rear" : "front",
                                 exact_range(charge.r_begin, charge.r_end)),
                     "bodies against all of it, or open_charge = true");
    }
  }
}

/// Bodies that hold each other through shared faces move as one projectile; another is in nobody's hands.
void check_hold(const SceneFile& file) {
  const Scene& scene = file.scene;
  const auto& bodies = scene.bodies;
  std::vector<bool> held(bodies.size());
  std::vector<std::size_t> reached{0};
  held[0] = true;
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (held[b] || !share_a_face(scene, bodies[reached[next]], bodies[b])) continue;
      held[b] = true;
      reached.push_back(b);
    }
  const auto loose = std::ranges::find(held, false);
  if (loose == held.end()) return;
  const Body& body = bodies[static_cast<std::size_t>(loose - held.begin())];
  throw fault_at(
      file, fmt::format("body.{}.x", body.name),
      fmt::format("\"{}\", r {}, where no face holds it to \"{}\"", exact_range(body.x_begin, body.x_end),
                  exact_range(body.r_begin, body.r_end), bodies.front().name),
      "bodies that hold each other through shared faces, directly or through others");
}

void check_chamber(const SceneFile& file) {
  const Chamber chamber = chamber_of(file.scene);
  if (chamber.unclear.empty()) return;
  const auto& stated = file.scene.load.obturation;
  throw fault_at(
      file, "load.obturation", (stated ? centimetres(*stated) + ", " : "") + chamber.unclear,
      fmt::format("a driving band in an annulus of the full radius, {}, that seals the chamber by itself "
                  "and with it the charge (the formulation \"total-lagrangian\" where not the "
                  "rearmost face alone is behind it)",
                  centimetres(extent_of(file.scene).r_end)));
}

}  // namespace

void check_near_edges(const SceneFile& file) {
  const auto& bodies = file.scene.bodies;
  const double tolerance = length_tolerance(file.scene),
               least = least_distance * file.scene.numerics.cell_size;
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    const Body& body = bodies[j];
    if (body.r_begin > tolerance && body.r_begin < least) throw fault_of(file, body, axis_r, 0.0, "the axis");
    for (std::size_t i = 0; i < j; ++i) {
      const Body& other = bodies[i];
      if (overlap(body, other, axis_x) < -least || overlap(body, other, axis_r) < -least) continue;
      for (const Axis& along : {axis_x, axis_r}) check_pair(file, body, other, along);
    }
  }
}

void check_support(const SceneFile& file) {
  for (const auto check : {check_ends, check_hold, check_chamber}) check(file);
}

}  // namespace launchsafe::scene
