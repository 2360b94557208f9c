#include "launchsafe/scene/chamber.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "scene_file.hpp"

#include <fmt/format.h>

#include <cmath>

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

/// The extent of a body along one axis.
struct Span {
  const char* axis = "x";
  double begin = 0, end = 0;  ///< m
};
Span span_x(const Body& body) { return {"x", body.x_begin, body.x_end}; }
Span span_r(const Body& body) { return {"r", body.r_begin, body.r_end}; }

/// How far two spans overlap, m; less than 0 for a distance.
double overlap(const Span& a, const Span& b) { return std::min(a.end, b.end) - std::max(a.begin, b.begin); }

/// An edge of a body where it begins or ends, beside a place that it nearly lies at.
struct NearEdge {
  const Body& body;
  Span span;
  bool at_end;
  double place;      ///< m
  std::string what;  ///< that lies there
};

InputError fault_of(const SceneFile& file, const NearEdge& near) {
  const double edge = near.at_end ? near.span.end : near.span.begin, distance = std::abs(edge - near.place);
  const std::string meant =
      near.at_end ? exact_range(near.span.begin, near.place) : exact_range(near.place, near.span.end);
  return fault_at(
      file, fmt::format("body.{}.{}", near.body.name, near.span.axis),
      fmt::format("\"{}\", which {} {:.3g} mm from {}, {}", exact_range(near.span.begin, near.span.end),
                  near.at_end ? "ends" : "begins", 1e3 * distance, near.what, centimetres(near.place)),
      fmt::format("that place, or one at least {} away: a tenth of numerics.cell_size",
                  length_text(least_distance * file.scene.numerics.cell_size)),
      fmt::format("{} = \"{}\"", near.span.axis, meant));
}

Fault fault_of_pair(const SceneFile& file, const Body& body, const Span& own, const Body& other,
                    const Span& others) {
  const double tolerance = length_tolerance(file.scene),
               least = least_distance * file.scene.numerics.cell_size;
  for (const bool at_end : {false, true})
    for (const bool others_end : {false, true}) {
      const double edge = at_end ? own.end : own.begin, place = others_end ? others.end : others.begin;
      const double distance = std::abs(edge - place);
      if (distance <= tolerance || distance >= least - tolerance) continue;
      return fault_of(file,
                      {body, own, at_end, place,
                       fmt::format("the {} of the body \"{}\"", others_end ? "end" : "begin", other.name)});
    }
  return std::nullopt;
}

/// The length of the charge's rear face along r that a body lies against, m.
double borne_length(const Scene& scene, const Body& charge) {
  double length = 0.0;
  for (const Body& body : scene.bodies)
    if (!is_charge(scene, body) && std::abs(body.x_begin - charge.x_end) <= length_tolerance(scene))
      length += std::max(0.0, overlap(span_r(body), span_r(charge)));
  return length;
}

/// The next body behind the charge's bottom, if there is one.
const Body* next_behind(const Scene& scene, const Body& charge) {
  const Body* next = nullptr;
  for (const Body& body : scene.bodies) {
    const bool behind = body.x_begin > charge.x_end && overlap(span_r(body), span_r(charge)) > 0.0;
    if (behind && (next == nullptr || body.x_begin < next->x_begin)) next = &body;
  }
  return next;
}

Fault check_bottom(const SceneFile& file) {
  const Scene& scene = file.scene;
  const double tolerance = length_tolerance(scene), bottom = charge_extent(scene).x_end;
  for (const Body& charge : scene.bodies) {
    if (!is_charge(scene, charge) || charge.x_end < bottom - tolerance) continue;
    const double width = charge.r_end - charge.r_begin, borne = borne_length(scene, charge);
    if (borne >= width - tolerance * static_cast<double>(scene.bodies.size())) continue;
    const Body* next = next_behind(scene, charge);
    const bool moves = next != nullptr && borne <= tolerance;
    return fault_at(
        file, "gap.thickness",
        fmt::format("a gap in the drawing: no body lies against {} of the bottom of \"{}\", x = {}, r {}{}",
                    borne > tolerance ? "a part" : "any part", charge.name, centimetres(bottom),
                    exact_range(charge.r_begin, charge.r_end),
                    next == nullptr
                        ? ""
                        : fmt::format("; \"{}\" begins at {}", next->name, centimetres(next->x_begin))),
        "a bottom that bears on a body all over; the gap is no part of the drawing, gap.thickness says it",
        moves ? fmt::format("body.{}.x = \"{}\"", next->name, exact_range(bottom, next->x_end))
              : std::string{});
  }
  return std::nullopt;
}

/// Bodies that hold each other through shared faces move as one projectile; another is in nobody's hands.
Fault check_hold(const SceneFile& file) {
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
  if (loose == held.end()) return std::nullopt;
  const Body& body = bodies[static_cast<std::size_t>(loose - held.begin())];
  return fault_at(
      file, fmt::format("body.{}.x", body.name),
      fmt::format("\"{}\", r {}, where no face holds it to \"{}\"", exact_range(body.x_begin, body.x_end),
                  exact_range(body.r_begin, body.r_end), bodies.front().name),
      "bodies that hold each other through shared faces, directly or through others", {});
}

Fault check_chamber(const SceneFile& file) {
  const Chamber chamber = chamber_of(file.scene);
  if (chamber.unclear.empty()) return std::nullopt;
  const auto& stated = file.scene.load.obturation;
  return fault_at(
      file, "load.obturation", (stated ? centimetres(*stated) + ", " : "") + chamber.unclear,
      fmt::format("a driving band in a ring of the full radius, {}, that closes the chamber by itself "
                  "and with it the charge (the formulation \"total-lagrangian\" where not the "
                  "rearmost face alone is behind it)",
                  centimetres(extent_of(file.scene).r_end)),
      {});
}

}  // namespace

Fault fault_of_near_edges(const SceneFile& file) {
  const auto& bodies = file.scene.bodies;
  const double tolerance = length_tolerance(file.scene),
               least = least_distance * file.scene.numerics.cell_size;
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    const Body& body = bodies[j];
    if (body.r_begin > tolerance && body.r_begin < least)
      return fault_of(file, {body, span_r(body), false, 0.0, "the axis"});
    for (std::size_t i = 0; i < j; ++i) {
      const Body& other = bodies[i];
      if (overlap(span_x(body), span_x(other)) < -least || overlap(span_r(body), span_r(other)) < -least)
        continue;
      if (Fault fault = fault_of_pair(file, body, span_x(body), other, span_x(other))) return fault;
      if (Fault fault = fault_of_pair(file, body, span_r(body), other, span_r(other))) return fault;
    }
  }
  return std::nullopt;
}

Fault fault_of_support(const SceneFile& file) {
  for (const auto check : {check_bottom, check_hold, check_chamber})
    if (Fault fault = check(file)) return fault;
  return std::nullopt;
}

}  // namespace launchsafe::scene
