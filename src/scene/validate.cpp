// What a scene must satisfy beyond the range of each key, before anything is computed.
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/scene/pressure_curve.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace launchsafe::scene {
namespace {

using Fault = std::optional<InputError>;

std::string centimetres(double length) { return format_quantity(length, Dimension::length); }

std::string range_text(double begin, double end) {
  return fmt::format("{:.6g} to {:.6g} cm", in_unit(begin, Dimension::length, "cm"),
                     in_unit(end, Dimension::length, "cm"));
}

/// Where the user gave a key; the file as a whole if it is a default.
Place place_of_key(const SceneFile& file, const std::string& key) {
  const auto given = file.given.find(key);
  if (given != file.given.end()) return given->second.place;
  const auto place = file.places.find(key);
  return place != file.places.end() ? place->second : Place{file.file};
}

InputError fault_at(const SceneFile& file, const std::string& key, std::string found, std::string allowed,
                    std::string suggestion = {}) {
  return error_at(place_of_key(file, key), key, std::move(found), std::move(allowed), std::move(suggestion));
}

/// Round-off of lengths written in decimals, m.
double tolerance_of(const SceneFile& file) {
  const Extent all = extent_of(file.scene);
  return 1e-9 * std::max(all.x_end - all.x_begin, all.r_end);
}

Fault check_names(const SceneFile& file) {
  if (file.scene.bodies.empty()) {
    return fault_at(file, "body", "no body", "at least one [[body]] with name, material, x and r");
  }
  std::set<std::string> names;
  for (const Body& body : file.scene.bodies) {
    if (body.name.empty() || !names.insert(body.name).second) {
      return fault_at(
          file, "body." + body.name + ".name",
          fmt::format("\"{}\" {}", body.name, body.name.empty() ? "without letters" : "a second time"),
          "a name that no other body has");
    }
  }
  names.clear();
  for (const ObservationPoint& point : file.scene.output.observation_points) {
    if (point.name.empty() || !names.insert(point.name).second) {
      return fault_at(
          file, "observation_point." + point.name + ".name",
          fmt::format("\"{}\" {}", point.name, point.name.empty() ? "without letters" : "a second time"),
          "a name that no other observation point has");
    }
  }
  return std::nullopt;
}

Fault check_charge_fits(const SceneFile& file) {
  const bool has_shell = std::any_of(file.scene.bodies.begin(), file.scene.bodies.end(),
                                     [&](const Body& body) { return !is_charge(file.scene, body); });
  if (!has_shell) return std::nullopt;
  const Extent shell = inert_extent(file.scene);
  const double tolerance = tolerance_of(file);
  for (const Body& body : file.scene.bodies) {
    if (!is_charge(file.scene, body)) continue;
    const auto sticks_out = [&](const char* axis, double begin, double end, double shell_begin,
                                double shell_end) {
      return fault_at(
          file, fmt::format("body.{}.{}", body.name, axis),
          fmt::format("\"{}\", which sticks out of the shell", range_text(begin, end)),
          fmt::format("a charge within the shell, {} {}", axis, range_text(shell_begin, shell_end)));
    };
    if (body.x_begin < shell.x_begin - tolerance || body.x_end > shell.x_end + tolerance) {
      return sticks_out("x", body.x_begin, body.x_end, shell.x_begin, shell.x_end);
    }
    if (body.r_begin < shell.r_begin - tolerance || body.r_end > shell.r_end + tolerance) {
      return sticks_out("r", body.r_begin, body.r_end, shell.r_begin, shell.r_end);
    }
  }
  return std::nullopt;
}

Fault check_overlaps(const SceneFile& file) {
  const double tolerance = tolerance_of(file);
  const auto& bodies = file.scene.bodies;
  for (std::size_t j = 1; j < bodies.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const Body &a = bodies[i], &b = bodies[j];
      const double x_begin = std::max(a.x_begin, b.x_begin), x_end = std::min(a.x_end, b.x_end);
      const double r_begin = std::max(a.r_begin, b.r_begin), r_end = std::min(a.r_end, b.r_end);
      if (x_end - x_begin <= tolerance || r_end - r_begin <= tolerance) continue;
      // The direction in which they overlap less is the one that was probably meant to be otherwise.
      const char* axis = x_end - x_begin < r_end - r_begin ? "x" : "r";
      return fault_at(file, fmt::format("body.{}.{}", b.name, axis),
                      fmt::format("\"{}\", which overlaps the body \"{}\" in x {}, r {}", b.name, a.name,
                                  range_text(x_begin, x_end), range_text(r_begin, r_end)),
                      "bodies that touch but do not overlap");
    }
  }
  return std::nullopt;
}

/// A body thinner than half a cell is not resolved by the mesh at all.
Fault check_cell_size(const SceneFile& file) {
  const double cell = file.scene.numerics.cell_size;
  double largest = std::numeric_limits<double>::infinity();
  const Body* thinnest = nullptr;
  for (const Body& body : file.scene.bodies) {
    const double allowed = 2.0 * std::min(body.x_end - body.x_begin, body.r_end - body.r_begin);
    if (allowed >= largest) continue;
    largest = allowed;
    thinnest = &body;
  }
  if (!thinnest || cell <= largest * (1.0 + 1e-9)) return std::nullopt;
  return fault_at(file, "numerics.cell_size",
                  fmt::format("{}, with which the body \"{}\", {} thick, has no particle of the mesh",
                              centimetres(cell), thinnest->name, centimetres(0.5 * largest)),
                  fmt::format("at most {} for this body", centimetres(largest)));
}

/// What only one of the formulations has is refused with the other, so that nobody believes it at work.
Fault check_formulation(const SceneFile& file) {
  const Numerics& numerics = file.scene.numerics;
  if (numerics.formulation == Formulation::total_lagrangian) return std::nullopt;
  const Numerics usual;
  const std::string even = " with formulation \"updated-lagrangian\", whose grid is even";
  const auto only = [&](const char* key, double found, double allowed, const std::string& why) -> Fault {
    if (!(found < allowed || found > allowed)) return std::nullopt;
    return fault_at(file, key, fmt::format("{:g}", found), fmt::format("{:g}{}", allowed, why));
  };
  const auto nothing = [&](const char* key, const std::vector<double>& found) -> Fault {
    if (found.empty()) return std::nullopt;
    return fault_at(file, key, centimetres(found.front()), "absent" + even);
  };
  if (Fault f = only("numerics.growth_x", numerics.growth_x, usual.growth_x, even)) return f;
  if (Fault f = only("numerics.growth_r", numerics.growth_r, usual.growth_r, even)) return f;
  if (Fault f = nothing("numerics.refined_x", numerics.refined_x)) return f;
  if (Fault f = nothing("numerics.refined_r", numerics.refined_r)) return f;
  return only("numerics.steel_inertia", numerics.steel_inertia, usual.steel_inertia,
              " with formulation \"updated-lagrangian\", which has one factor on all inertia");
}

/// Refined lines belong to the bodies.
Fault check_refinement(const SceneFile& file) {
  const Extent all = extent_of(file.scene);
  const double tolerance = tolerance_of(file);
  const auto outside = [&](const std::vector<double>& places, double begin, double end) {
    return std::find_if(places.begin(), places.end(),
                        [&](double place) { return place < begin - tolerance || place > end + tolerance; });
  };
  const Numerics& numerics = file.scene.numerics;
  if (const auto x = outside(numerics.refined_x, all.x_begin, all.x_end); x != numerics.refined_x.end())
    return fault_at(file, "numerics.refined_x", centimetres(*x),
                    "places in the shell, x " + range_text(all.x_begin, all.x_end));
  if (const auto r = outside(numerics.refined_r, all.r_begin, all.r_end); r != numerics.refined_r.end())
    return fault_at(file, "numerics.refined_r", centimetres(*r),
                    "radii in the shell, r " + range_text(all.r_begin, all.r_end));
  return std::nullopt;
}

/// Whether a peak was given that the measured curve makes useless. A study that gives a scene a curve
/// replaces its peak.
bool has_useless_peak(const SceneFile& file) {
  const auto peak = file.given.find("load.peak"), curve = file.given.find("load.curve");
  if (peak == file.given.end()) return false;
  const bool replaced = curve != file.given.end() && curve->second.place.file != file.file &&
                        peak->second.place.file == file.file;
  return !replaced;
}

/// A measured curve beside a peak that would silently do nothing, and one that ends too early. A scene
/// written back has its curve's points rather than their file, and every key: its peak is no sign of a
/// mistake.
Fault check_curve_use(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.curve_time.empty()) return std::nullopt;
  if (!load.curve_file.empty() && !load.rescale_to_peak && has_useless_peak(file)) {
    return fault_at(file, "load.peak",
                    format_quantity(load.peak, Dimension::pressure) +
                        " beside a measured curve, which has a peak of its own",
                    "load.curve alone, or both with load.rescale_to_peak = true");
  }
  if (load.curve_time.back() < load.duration * (1.0 - 1e-9)) {
    const char* key = load.curve_file.empty() ? "load.curve_time" : "load.curve";
    return fault_at(file, key,
                    "a curve that ends at " + format_quantity(load.curve_time.back(), Dimension::time),
                    "a curve that lasts until the end of the launch, " +
                        format_quantity(load.duration, Dimension::time) + ", or a shorter load.duration");
  }
  return std::nullopt;
}

/// A curve of next to nothing has no shape that could be scaled.
Fault check_rescaling(const SceneFile& file) {
  constexpr double least_peak = 1.0;  // Pa
  const Load& load = file.scene.load;
  if (load.curve_pressure.empty() || !load.rescale_to_peak) return std::nullopt;
  const double measured = *std::max_element(load.curve_pressure.begin(), load.curve_pressure.end());
  if (measured >= least_peak) return std::nullopt;
  return fault_at(file, "load.rescale_to_peak",
                  fmt::format("true with a curve whose largest pressure is {}",
                              format_quantity(measured, Dimension::pressure)),
                  "a curve that reaches " + format_quantity(least_peak, Dimension::pressure));
}

Fault check_smoothing(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (!(load.smoothing > 0.0)) return std::nullopt;
  const std::string window = format_quantity(load.smoothing, Dimension::time);
  if (load.curve_time.empty())
    return fault_at(file, "load.smoothing", window + " without a measured curve",
                    "a window only together with load.curve");
  const double length = load.curve_time.back() - load.curve_time.front();
  if (load.smoothing >= least_smoothing_share * length && load.smoothing <= length) return std::nullopt;
  return fault_at(file, "load.smoothing", window,
                  fmt::format("a window from {} to that of the measured curve, {}, or 0 ms for none",
                              format_quantity(least_smoothing_share * length, Dimension::time),
                              format_quantity(length, Dimension::time)));
}

Fault check_load(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.curve_time.size() != load.curve_pressure.size()) {
    return fault_at(file, "load.curve_pressure",
                    fmt::format("{} values for {} times", load.curve_pressure.size(), load.curve_time.size()),
                    "one pressure for every time");
  }
  if (load.curve_time.size() == 1) {
    return fault_at(file, "load.curve_time", "1 point", "a curve of at least two points");
  }
  const auto& times = load.curve_time;
  const auto late = std::adjacent_find(times.begin(), times.end(),
                                       [](double a, double b) { return !(b - a > least_curve_interval); });
  if (late != times.end()) {
    return fault_at(file, "load.curve_time",
                    fmt::format("{} followed by {}", format_quantity(*late, Dimension::time),
                                format_quantity(*std::next(late), Dimension::time)),
                    "times in increasing order, more than " +
                        format_quantity(least_curve_interval, Dimension::time) + " apart");
  }
  if (Fault fault = check_curve_use(file)) return fault;
  if (Fault fault = check_rescaling(file)) return fault;
  if (times.empty() && load.rescale_to_peak) {
    return fault_at(file, "load.rescale_to_peak", "true without a measured curve",
                    "true together with load.curve");
  }
  if (Fault fault = check_smoothing(file)) return fault;
  if (times.empty() && load.base > load.peak) {
    return fault_at(
        file, file.given.contains("load.base") ? "load.base" : "load.peak",
        fmt::format("a base of {} and a peak of {}", format_quantity(load.base, Dimension::pressure),
                    format_quantity(load.peak, Dimension::pressure)),
        "a base pressure of at most the peak");
  }
  return std::nullopt;
}

Fault check_kinetics(const SceneFile& file) {
  const materials::KineticsParameters& kinetics = file.scene.charge().kinetics;
  const double initial = file.scene.initial_temperature;
  if (!(kinetics.ignition_temperature < kinetics.burnt_temperature)) {
    const bool burnt = file.given.contains("kinetics.burnt_temperature");
    return fault_at(file, burnt ? "kinetics.burnt_temperature" : "kinetics.ignition_temperature",
                    fmt::format("an ignition temperature of {:.6g} K and a burnt temperature of {:.6g} K",
                                kinetics.ignition_temperature, kinetics.burnt_temperature),
                    "an ignition temperature below the burnt temperature");
  }
  if (!(initial < kinetics.ignition_temperature)) {
    return fault_at(file, "kinetics.ignition_temperature",
                    fmt::format("{:.6g} K", kinetics.ignition_temperature),
                    fmt::format("a temperature above the initial {:.6g} K", initial));
  }
  return std::nullopt;
}

/// An equation of state with the shape of an unreacted explosive's: it resists compression.
Fault check_jwl(const SceneFile& file) {
  const materials::JwlParameters& eos = file.scene.charge().eos;
  if (!(eos.r1 > eos.r2)) {
    const bool second = file.given.contains("charge.jwl.r2");
    return fault_at(file, second ? "charge.jwl.r2" : "charge.jwl.r1",
                    fmt::format("R1 = {:.6g} and R2 = {:.6g}", eos.r1, eos.r2), "R1 above R2");
  }
  const double bulk = materials::jwl_bulk_modulus(eos, 1.0, eos.initial_energy);
  if (bulk > 0.0) return std::nullopt;
  std::string key = "charge.jwl.a";
  for (const char* each : {"charge.jwl.b", "charge.jwl.r1", "charge.jwl.r2", "charge.jwl.omega"}) {
    if (!file.given.contains("charge.jwl.a") && file.given.contains(each)) key = each;
  }
  return fault_at(file, key,
                  fmt::format("a JWL with a bulk modulus of {:.4g} GPa before launch", 1e-9 * bulk),
                  "constants whose bulk modulus is above 0 GPa");
}

Fault check_steel(const SceneFile& file) {
  const materials::JohnsonCookParameters& steel = file.scene.steel().strength;
  if (steel.room_temperature < steel.melting_temperature) return std::nullopt;
  return fault_at(file, "steel.melting_temperature", fmt::format("{:.6g} K", steel.melting_temperature),
                  fmt::format("a temperature above the room temperature, {:.6g} K", steel.room_temperature));
}

Fault check_crack_friction(const SceneFile& file) {
  const auto flag = file.given.find("charge.crack_friction");
  const auto coefficient = file.given.find("charge.face_friction");
  if (flag == file.given.end() || coefficient == file.given.end()) return std::nullopt;
  const bool on = std::get<bool>(flag->second.value);
  const double friction = std::get<double>(coefficient->second.value);
  if (on == (friction > 0.0)) return std::nullopt;
  return fault_at(
      file, "charge.crack_friction", fmt::format("{} with face_friction = {}", on, friction),
      on ? "true with a face_friction above 0" : "false with a face_friction of 0, or without one");
}

Fault check_gaps(const SceneFile& file) {
  std::vector<double> gaps = file.scene.surface.gaps;
  std::sort(gaps.begin(), gaps.end());
  const auto twice = std::adjacent_find(gaps.begin(), gaps.end(),
                                        [](double a, double b) { return b - a <= 1e-9 * std::max(b, 1e-6); });
  if (twice != gaps.end()) {
    return fault_at(file, "gap.thickness", fmt::format("{} twice", centimetres(*twice)), "each gap once");
  }
  if (!gaps.empty() && gaps.back() > 0.0 && !has_charge(file.scene)) {
    return fault_at(file, "gap.thickness",
                    fmt::format("a gap of {} in a scene without a charge", centimetres(gaps.back())),
                    "gaps only under a body of material \"charge\"");
  }
  return std::nullopt;
}

bool inside(const Body& body, const ObservationPoint& point, double tolerance) {
  return point.x >= body.x_begin - tolerance && point.x <= body.x_end + tolerance &&
         point.r >= body.r_begin - tolerance && point.r <= body.r_end + tolerance;
}

/// The stations that nothing is said of are as wide as a charge that is narrower, and end with a shorter one.
Fault check_stations(const SceneFile& file) {
  if (!has_charge(file.scene)) return std::nullopt;
  const Extent charge = charge_extent(file.scene);
  const double tolerance = tolerance_of(file);
  const auto fault = [&](const char* key, double given, double usual, double largest,
                         const char* what) -> Fault {
    if (given <= largest + tolerance || !(given < usual || given > usual)) return std::nullopt;
    return fault_at(file, key, centimetres(given),
                    fmt::format("at most the charge's {}, {}", what, centimetres(largest)));
  };
  const Surface usual;
  if (Fault wide = fault("station.width", file.scene.surface.station_width, usual.station_width,
                         charge.r_end - charge.r_begin, "width"))
    return wide;
  return fault("station.depth", file.scene.surface.station_depth, usual.station_depth,
               charge.x_end - charge.x_begin, "length");
}

/// m. Observation points read the skin of the charge's bottom.
constexpr double largest_point_depth = 10e-3;

Fault check_observation_points(const SceneFile& file) {
  const double tolerance = tolerance_of(file);
  for (const ObservationPoint& point : file.scene.output.observation_points) {
    const bool in_charge = std::any_of(
        file.scene.bodies.begin(), file.scene.bodies.end(),
        [&](const Body& body) { return is_charge(file.scene, body) && inside(body, point, tolerance); });
    const double depth = charge_extent(file.scene).x_end - point.x;
    if (in_charge && depth > largest_point_depth + tolerance) {
      return fault_at(file, fmt::format("observation_point.{}.x", point.name), centimetres(point.x),
                      fmt::format("at most {} from the charge's bottom, whose temperatures it reads",
                                  centimetres(largest_point_depth)));
    }
    if (in_charge) continue;
    const Extent charge = charge_extent(file.scene);
    const bool in_x = point.x >= charge.x_begin - tolerance && point.x <= charge.x_end + tolerance;
    std::string allowed = "none: the scene has no charge";
    if (has_charge(file.scene)) {
      allowed = fmt::format("a point in the charge, x {}, r {}", range_text(charge.x_begin, charge.x_end),
                            range_text(charge.r_begin, charge.r_end));
    }
    return fault_at(file, fmt::format("observation_point.{}.{}", point.name, in_x ? "r" : "x"),
                    fmt::format("x {}, r {}", centimetres(point.x), centimetres(point.r)), allowed);
  }
  return std::nullopt;
}

/// In the lab frame the whole shell would fly as a heavier one.
Fault check_inertia(const SceneFile& file) {
  if (file.scene.frame == Frame::co_moving) return std::nullopt;
  const Numerics& numerics = file.scene.numerics;
  for (const auto& [key, factor] : {std::pair{"numerics.inertial_scaling", numerics.inertial_scaling},
                                    std::pair{"numerics.steel_inertia", numerics.steel_inertia}})
    if (factor > 1.0)
      return fault_at(file, key, fmt::format("{:.6g} in the lab frame", factor),
                      "1 in the lab frame; more than 1 only with frame = \"co-moving\"");
  return std::nullopt;
}

Fault check_output(const SceneFile& file) {
  const double duration = file.scene.load.duration;
  const std::string until = format_quantity(duration, Dimension::time);
  if (file.scene.output.trace_interval > duration) {
    return fault_at(file, "output.trace_interval",
                    format_quantity(file.scene.output.trace_interval, Dimension::time),
                    "an interval of at most the load's duration, " + until);
  }
  std::vector<double> times = file.scene.output.snapshot_times;
  std::sort(times.begin(), times.end());
  if (const auto twice = std::adjacent_find(times.begin(), times.end()); twice != times.end())
    return fault_at(file, "output.snapshots", format_quantity(*twice, Dimension::time) + " twice",
                    "each time once");
  for (const double time : times) {
    if (time <= duration * (1.0 + 1e-12)) continue;
    return fault_at(file, "output.snapshots", format_quantity(time, Dimension::time),
                    "times from 0 ms to the load's duration, " + until);
  }
  return std::nullopt;
}

}  // namespace

std::optional<InputError> validate(const SceneFile& file) {
  for (const auto check :
       {check_names, check_charge_fits, check_overlaps, check_interfaces, check_cell_size, check_load,
        check_kinetics, check_jwl, check_steel, check_crack_friction, check_gaps, check_stations,
        check_observation_points, check_formulation, check_inertia, check_refinement, check_output}) {
    if (Fault fault = check(file)) return fault;
  }
  return std::nullopt;
}

}  // namespace launchsafe::scene
