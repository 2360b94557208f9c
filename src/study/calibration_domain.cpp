#include "launchsafe/study/calibration_domain.hpp"

#include "foreign_material.hpp"
#include "launchsafe/scene/quantity.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace launchsafe::study {
namespace {

using scene::Scene, scene::Value;

/// What another value of a scene key does to the calibration.
enum class Role {
  none,        ///< judged elsewhere, or computes nothing
  condition,   ///< the launch: the constants' relative errors are carried to its own temperature rises
  load_shape,  ///< likewise
  numerics,    ///< another mesh error than the one that the constants absorbed
  hot_above,   ///< a calibrated constant; a larger one makes a hotter skin or an earlier ignition
  hot_below,   ///< likewise, a smaller one
  model        ///< another law, material or constant
};

struct NamedRole {
  std::string_view key;
  Role role;
};

/// Keys that are not what their table is.
// clang-format off
constexpr std::array special_keys{
    NamedRole{"title", Role::none},
    NamedRole{"charge.title", Role::none},
    NamedRole{"steel.title", Role::none},
    NamedRole{"elastic.title", Role::none},
    NamedRole{"coupling", Role::none},                 // acts after ignition, as do the keys of combustion
    NamedRole{"frame", Role::numerics},
    NamedRole{"initial_temperature", Role::condition},
    NamedRole{"load.peak", Role::condition},
    NamedRole{"load.curve", Role::none},               // its points count
    NamedRole{"load.muzzle_exit_spread", Role::none},  // of what is not known, not of the launch
    NamedRole{"load.expected_velocity", Role::none},   // a check
    NamedRole{"charge.crack_radius", Role::condition},
    NamedRole{"charge.flaw_size", Role::condition},
    NamedRole{"gap.thickness", Role::none},            // judged row by row
    NamedRole{"gap.air_density", Role::condition},
    NamedRole{"gap.air_temperature", Role::condition},
    NamedRole{"gap.air_pressure", Role::condition},
    NamedRole{"gap.exchange_time", Role::hot_below},
    NamedRole{"friction.localisation", Role::hot_above},
    NamedRole{"kinetics.set", Role::none},             // its numbers count
    NamedRole{"kinetics.activation_temperature", Role::hot_below},
    NamedRole{"kinetics.ignition_temperature", Role::hot_below},
    NamedRole{"load.obturation", Role::none},  // same_shell compares it
    NamedRole{"numerics.energy_drift_limit", Role::none},
    NamedRole{"numerics.time_step_factor", Role::none}  // moves T max by less than 0.1 K (reports/accuracy)
};
// clang-format on

Role role_of(std::string_view key) {
  for (const NamedRole& each : special_keys) {
    if (each.key == key) return each.role;
  }
  if (key.starts_with("load.")) return Role::load_shape;
  if (key.starts_with("numerics.")) return Role::numerics;
  for (const std::string_view table : {"output.", "physics.", "combustion."})
    if (key.starts_with(table)) return Role::none;
  return Role::model;
}

/// m; much less than any tolerance of a drawing.
constexpr double same_place = 1e-6;

bool near(double a, double b) { return std::abs(a - b) <= same_place; }

bool share_place(const scene::Body& a, const scene::Body& b) {
  return near(a.x_begin, b.x_begin) && near(a.x_end, b.x_end) && near(a.r_begin, b.r_begin) &&
         near(a.r_end, b.r_end);
}

/// Whether bodies are of one law at the same places: what the constants of their materials are is compared by
/// itself, and names are the user's.
bool same_shell(const Scene& a, const Scene& b) {
  if (a.load.obturation.has_value() != b.load.obturation.has_value()) return false;
  if (a.load.obturation && !near(*a.load.obturation, *b.load.obturation)) return false;
  const auto same_body = [&](const scene::Body& of_a, const scene::Body& of_b) {
    return share_place(of_a, of_b) && scene::law_of(a, of_a).index() == scene::law_of(b, of_b).index();
  };
  return std::is_permutation(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), same_body);
}

/// What another value of the shell is told by: its size, and a digest of its bodies.
std::string shell_value(const Scene& scene) {
  std::vector<std::string> bodies;
  for (const scene::Body& body : scene.bodies) {
    const auto place = [](double length) { return std::llround(length / same_place); };
    bodies.push_back(fmt::format("{} {} {} {} {}", scene::law_of(scene, body).index(), place(body.x_begin),
                                 place(body.x_end), place(body.r_begin), place(body.r_end)));
  }
  std::sort(bodies.begin(), bodies.end());
  const scene::Extent all = scene::extent_of(scene);
  return fmt::format("{} bodies, {} long, {} in diameter, {}", bodies.size(),
                     scene::length_text(all.x_end - all.x_begin), scene::length_text(2.0 * all.r_end),
                     short_digest(fmt::format("{}", fmt::join(bodies, "\n"))));
}

std::string interfaces_value(const Scene& scene) {
  std::string text;
  const auto add = [&text](const char* name, const std::optional<double>& value, scene::Dimension dimension) {
    if (value) text += fmt::format(", {} {}", name, scene::format_quantity(*value, dimension));
  };
  for (const scene::Interface& each : scene::sliding_interfaces(scene)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", each.body,
                        each.condition == scene::Condition::sliding ? "sliding" : "bonded");
    add("friction", each.friction, scene::Dimension::number);
    add("tension", each.tension_strength, scene::Dimension::pressure);
    add("shear", each.shear_strength, scene::Dimension::pressure);
  }
  return text.empty() ? "bonded for good" : text;
}

/// Of what is no key of the scene.
scene::Implausible foreign(const Scene& scene, const char* name, const std::string& value,
                           std::string calibrated) {
  return scene::implausible(scene.accepted, {.kind = scene::KeyKind::text}, name, Value(value),
                            std::move(calibrated));
}

std::string name_of_condition(const std::string& key) {
  if (key == "load.peak") return "peak pressure";
  if (key == "charge.crack_radius") return "crack radius";
  if (key == "charge.flaw_size") return "flaw size";
  if (key == "initial_temperature") return "initial temperature";
  return key;
}

void add_difference(CalibrationDistance& distance, const Scene& scene, const scene::KeyDescription& key,
                    const Value& value, const Value& calibrated) {
  const Role role = role_of(key.name);
  const auto add_foreign = [&] {
    distance.foreign.push_back(scene::implausible(scene.accepted, key, key.name, value,
                                                  "calibrated with " + scene::format_value(key, calibrated)));
  };
  switch (role) {
    case Role::none:
      return;
    case Role::condition:
      distance.carried.push_back(name_of_condition(key.name));
      return;
    case Role::load_shape:
      distance.other_load_shape = true;
      return;
    case Role::numerics:
      distance.other_numerics = true;
      return;
    case Role::hot_above:
    case Role::hot_below: {
      const bool hotter =
          (std::get<double>(value) > std::get<double>(calibrated)) == (role == Role::hot_above);
      if (!hotter) return add_foreign();
      distance.carried.push_back(key.name);
      return;
    }
    case Role::model:
      return add_foreign();
  }
}

const scene::Body* find_body(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                  [&name](const scene::Body& body) { return body.name == name; });
  return found == scene.bodies.end() ? nullptr : &*found;
}

/// Bodies of the same shell are compared by what they are: another scene may give them other names. Those of
/// another shell have other places, and are compared by name.
bool same_interface(const scene::Interface& a, const Scene& scene_of_a, const scene::Interface& b,
                    const Scene& scene_of_b, bool same_shell) {
  const scene::Body *body = find_body(scene_of_a, a.body), *other = find_body(scene_of_b, b.body);
  if (body == nullptr || other == nullptr) return false;
  const bool same = same_shell ? share_place(*body, *other) : body->name == other->name;
  return same && a.condition == b.condition && a.friction == b.friction &&
         a.tension_strength == b.tension_strength && a.shear_strength == b.shear_strength;
}

/// Whether the same faces slide in both scenes in the same way.
bool same_interfaces(const Scene& scene, const Scene& calibrated, bool same_shell) {
  const auto ours = scene::sliding_interfaces(scene), theirs = scene::sliding_interfaces(calibrated);
  return std::is_permutation(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                             [&](const scene::Interface& one, const scene::Interface& other) {
                               return same_interface(one, scene, other, calibrated, same_shell);
                             });
}

}  // namespace

Scene calibration_scene() {
  Scene scene;
  scene.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  for (const char* body : {"nose", "wall"})
    scene.interfaces.push_back({.body = body, .condition = scene::Condition::sliding, .friction = 0.0});
  scene.load.muzzle_exit = 18e-3;  // where the published rows are read
  scene.numerics.cell_size = 1.25e-3;
  scene.numerics.growth_x = scene.numerics.growth_r = 1.3;
  scene.numerics.largest_cell = 20e-3;
  scene.numerics.time_step_factor = 0.65;
  return scene;
}

Calibration shipped_calibration() { return {calibration_scene(), {}}; }

std::vector<std::string> CalibrationDistance::names() const {
  std::vector<std::string> names;
  for (const scene::Implausible& each : foreign) names.push_back(each.key);
  names.insert(names.end(), carried.begin(), carried.end());
  return names;
}

CalibrationDistance distance_to_calibration(const Scene& scene, const Calibration& calibration) {
  const Scene& calibrated = calibration.scene;
  CalibrationDistance distance;
  const bool shells_agree = same_shell(scene, calibrated);
  if (!shells_agree)
    distance.foreign.push_back(foreign(scene, scene::foreign_shell, shell_value(scene),
                                       "calibrated with " + shell_value(calibrated)));
  for (const auto& key : scene::scene_keys()) {
    const Value value = key.get(scene), wanted = key.get(calibrated);
    if (!same_value(value, wanted)) add_difference(distance, scene, key, value, wanted);
  }
  add_other_materials(scene, calibrated, shells_agree ? share_place : nullptr, distance.foreign);
  summarise_materials(scene, distance.foreign);
  if (!same_interfaces(scene, calibrated, shells_agree))
    distance.foreign.push_back(foreign(scene, scene::foreign_interfaces, interfaces_value(scene),
                                       "calibrated with " + interfaces_value(calibrated)));
  const double peak = scene::PressureHistory(scene.load).stated_peak();
  const bool measured = !scene.load.curve_time.empty() || !calibrated.load.curve_time.empty();
  std::erase_if(distance.carried,
                [measured](const auto& each) { return measured && each == "peak pressure"; });
  if (measured && !same_number(peak, scene::PressureHistory(calibrated.load).stated_peak()))
    distance.carried.emplace_back("peak pressure");
  if (distance.other_load_shape) distance.carried.emplace_back("load shape");
  if (distance.other_numerics) distance.carried.emplace_back("numerics");
  return distance;
}

}  // namespace launchsafe::study
