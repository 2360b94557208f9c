// Where bodies lie: together they must be a shell that a grid can show, whose charge nothing but the gap
// bares.
#include "launchsafe/scene/load.hpp"
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// Of numerics.cell_size: edges closer than this to each other are shown by no grid.
constexpr double least_distance = 0.1;

std::string exact_range(double begin, double end) {
  return fmt::format("{:.10g} to {:.10g} cm", 100.0 * begin, 100.0 * end);
}

/// A fault of a body along an axis.
InputError fault_of(const SceneFile& file, const Body& body, const Axis& along, const std::string& what,
                    const std::string& allowed) {
  return fault_at(file, fmt::format("body.{}.{}", body.name, along.name),
                  fmt::format("\"{}\", {}", exact_range(body.*along.begin, body.*along.end), what), allowed);
}

void check_overlap(const SceneFile& file, const Body& body, const Body& other) {
  const double tolerance = length_tolerance(file.scene);
  const double along_x = overlap(body, other, axis_x), along_r = overlap(body, other, axis_r);
  if (along_x <= tolerance || along_r <= tolerance) return;
  // The direction in which they overlap less is the one that was probably meant to be otherwise.
  const Axis& axis = along_x < along_r ? axis_x : axis_r;
  const auto shared = [&](const Axis& along) {
    return fmt::format("{} {:.6g} to {:.6g} cm", along.name,
                       100.0 * std::max(body.*along.begin, other.*along.begin),
                       100.0 * std::min(body.*along.end, other.*along.end));
  };
  throw fault_at(file, fmt::format("body.{}.{}", body.name, axis.name),
                 fmt::format("\"{}\", which overlaps the body \"{}\" in {}, {}", body.name, other.name,
                             shared(axis_x), shared(axis_r)),
                 "bodies that touch but do not overlap");
}

/// Edges that nearly but not quite lie at one place.
void check_near_edges(const SceneFile& file, const Body& body, const Body& other, const Axis& along) {
  const double tolerance = length_tolerance(file.scene),
               least = least_distance * file.scene.numerics.cell_size;
  if (overlap(body, other, axis_x) < -least || overlap(body, other, axis_r) < -least) return;
  for (const double own : {body.*along.begin, body.*along.end})
    for (const double place : {other.*along.begin, other.*along.end}) {
      if (std::abs(own - place) <= tolerance || std::abs(own - place) >= least - tolerance) continue;
      throw fault_of(file, body, along,
                     fmt::format("near the edge of \"{}\" at {:.10g} cm", other.name, 100.0 * place),
                     "that place, or one at least a tenth of numerics.cell_size away");
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

/// Bodies lie against all of the charge's ends, at the bottom always: the gap is no part of the drawing.
void check_ends(const SceneFile& file, const Body& charge, bool rear) {
  const Scene& scene = file.scene;
  const double tolerance = length_tolerance(scene);
  const double width = charge.r_end - charge.r_begin, covered = covered_length(scene, charge, rear);
  if (covered >= width - tolerance * static_cast<double>(scene.bodies.size())) return;
  if (rear && charge.x_end >= charge_extent(scene).x_end - tolerance)
    throw fault_at(
        file, "gap.thickness",
        fmt::format("a gap in the drawing: no body lies against all of the bottom of \"{}\"", charge.name),
        "a bottom that bears on a body all over; gap.thickness says how far it does not");
  if (!scene.open_charge)
    throw fault_of(file, charge, axis_x,
                   fmt::format("where no body covers all of its {}", rear ? "rear" : "front"),
                   "bodies against all of it, or open_charge = true");
}

/// Bodies that hold each other through shared faces move as one projectile; another is in nobody's hands.
void check_hold(const SceneFile& file) {
  const auto& bodies = file.scene.bodies;
  std::vector<bool> held(bodies.size());
  std::vector<std::size_t> reached{0};
  held[0] = true;
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (held[b] || !share_a_face(file.scene, bodies[reached[next]], bodies[b])) continue;
      held[b] = true;
      reached.push_back(b);
    }
  const auto loose = std::ranges::find(held, false);
  if (loose == held.end()) return;
  throw fault_of(file, bodies[static_cast<std::size_t>(loose - held.begin())], axis_x,
                 fmt::format("where no face holds it to \"{}\"", bodies.front().name),
                 "bodies that hold each other through shared faces, directly or through others");
}

}  // namespace

bool share_a_face(const Scene& scene, const Body& a, const Body& b) {
  const double tolerance = length_tolerance(scene);
  const double along_x = overlap(a, b, axis_x), along_r = overlap(a, b, axis_r);
  return (std::abs(along_x) <= tolerance && along_r > tolerance) ||
         (std::abs(along_r) <= tolerance && along_x > tolerance);
}

std::vector<std::string> bodies_at_the_charge(const Scene& scene) {
  std::vector<std::string> touching;
  for (const Body& body : scene.bodies)
    if (!is_charge(scene, body) && std::ranges::any_of(scene.bodies, [&](const Body& other) {
          return is_charge(scene, other) && share_a_face(scene, body, other);
        }))
      touching.push_back(body.name);
  return touching;
}

void check_geometry(const SceneFile& file) {
  const auto& bodies = file.scene.bodies;
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    if (bodies[j].r_begin > length_tolerance(file.scene) &&
        bodies[j].r_begin < least_distance * file.scene.numerics.cell_size)
      throw fault_of(file, bodies[j], axis_r, "near the axis",
                     "0 cm, or at least a tenth of numerics.cell_size");
    for (std::size_t i = 0; i < j; ++i) {
      for (const Axis& along : {axis_x, axis_r}) check_near_edges(file, bodies[j], bodies[i], along);
      check_overlap(file, bodies[j], bodies[i]);
    }
  }
  for (const Body& body : bodies)
    if (is_charge(file.scene, body))
      for (const bool rear : {true, false}) check_ends(file, body, rear);
  check_hold(file);
  if (!chamber_of(file.scene).sealed)
    throw fault_at(
        file, "load.obturation", "a chamber whose gas passes the driving band or reaches the charge",
        "a driving band in an annulus of the full radius that seals the chamber (with the formulation "
        "\"total-lagrangian\" where not the rearmost face alone is behind it)");
}

}  // namespace launchsafe::scene
