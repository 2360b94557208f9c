// What a scene must satisfy beyond the range of each key, before anything is computed.
#include "scene_file.hpp"

#include <set>
#include <tuple>

namespace launchsafe::scene {
namespace {

std::string range_text(double begin, double end) {
  return fmt::format("{:.6g} to {:.6g} cm", in_unit(begin, Dimension::length, "cm"),
                     in_unit(end, Dimension::length, "cm"));
}

template <class Owner>
void check_names_of(const SceneFile& file, const std::string& table, const std::string& what,
                    const std::vector<Owner>& owners) {
  std::set<std::string> names;
  for (const Owner& owner : owners) {
    if (!owner.name.empty() && names.insert(owner.name).second) continue;
    throw fault_at(
        file, table + "." + owner.name + ".name",
        fmt::format("\"{}\" {}", owner.name, owner.name.empty() ? "without letters" : "a second time"),
        fmt::format("a name that no other {} has", what));
  }
}

void check_names(const SceneFile& file) {
  if (file.scene.bodies.empty())
    throw fault_at(file, "body", "no body", "at least one [[body]] with name, material, x and r");
  check_names_of(file, "body", "body", file.scene.bodies);
  check_names_of(file, "observation_point", "observation point", file.scene.output.observation_points);
}

void check_overlaps(const SceneFile& file) {
  const double tolerance = length_tolerance(file.scene);
  const auto& bodies = file.scene.bodies;
  for (std::size_t j = 1; j < bodies.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const Body &a = bodies[i], &b = bodies[j];
      const double x_begin = std::max(a.x_begin, b.x_begin), x_end = std::min(a.x_end, b.x_end);
      const double r_begin = std::max(a.r_begin, b.r_begin), r_end = std::min(a.r_end, b.r_end);
      if (x_end - x_begin <= tolerance || r_end - r_begin <= tolerance) continue;
      // The direction in which they overlap less is the one that was probably meant to be otherwise.
      const char* axis = x_end - x_begin < r_end - r_begin ? "x" : "r";
      throw fault_at(file, fmt::format("body.{}.{}", b.name, axis),
                     fmt::format("\"{}\", which overlaps the body \"{}\" in x {}, r {}", b.name, a.name,
                                 range_text(x_begin, x_end), range_text(r_begin, r_end)),
                     "bodies that touch but do not overlap");
    }
  }
}

/// A body thinner than half a cell is not resolved by the mesh at all.
void check_cell_size(const SceneFile& file) {
  const double cell = file.scene.numerics.cell_size;
  const auto thickness = [](const Body& body) {
    return std::min(body.x_end - body.x_begin, body.r_end - body.r_begin);
  };
  const Body& thinnest = *std::ranges::min_element(file.scene.bodies, {}, thickness);
  const double largest = 2.0 * thickness(thinnest);
  if (cell <= largest * (1.0 + 1e-9)) return;
  throw fault_at(file, "numerics.cell_size",
                 fmt::format("{}, with which the body \"{}\", {} thick, has no particle of the mesh",
                             length_text(cell), thinnest.name, length_text(0.5 * largest)),
                 fmt::format("at most {} for this body", length_text(largest)));
}

/// What only one of the formulations has is refused with the other, so that nobody believes it at work.
void check_formulation(const SceneFile& file) {
  const Numerics& numerics = file.scene.numerics;
  if (numerics.formulation == Formulation::total_lagrangian) return;
  const std::string with_it = " with formulation \"updated-lagrangian\", ",
                    even = with_it + "whose grid is even";
  for (const auto& [key, factor, allowed] : {std::tuple{"numerics.growth_x", numerics.growth_x, "1" + even},
                                             {"numerics.growth_r", numerics.growth_r, "1" + even},
                                             {"numerics.selective_inertia", numerics.selective_inertia,
                                              "1" + with_it + "which has one factor on all inertia"}})
    if (factor > 1.0) throw fault_at(file, key, fmt::format("{:g}", factor), allowed);
}

void check_kinetics(const SceneFile& file) {
  const materials::KineticsParameters& kinetics = file.scene.charge().kinetics;
  const double initial = file.scene.initial_temperature;
  if (!(kinetics.ignition_temperature < kinetics.burnt_temperature)) {
    const bool burnt = file.given.contains("kinetics.burnt_temperature");
    throw fault_at(file, burnt ? "kinetics.burnt_temperature" : "kinetics.ignition_temperature",
                   fmt::format("an ignition temperature of {:.6g} K and a burnt temperature of {:.6g} K",
                               kinetics.ignition_temperature, kinetics.burnt_temperature),
                   "an ignition temperature below the burnt temperature");
  }
  if (!(initial < kinetics.ignition_temperature))
    throw fault_at(file, "kinetics.ignition_temperature",
                   fmt::format("{:.6g} K", kinetics.ignition_temperature),
                   fmt::format("a temperature above the initial {:.6g} K", initial));
}

void check_equation_of_state(const SceneFile& file) {
  const auto fault = materials::fault_of(file.scene.charge().eos);
  if (!fault) return;
  const auto given = std::ranges::find_if(
      fault->keys, [&](const std::string& key) { return file.given.contains("charge." + key); });
  throw fault_at(file, "charge." + (given != fault->keys.end() ? *given : fault->keys.front()), fault->found,
                 fault->allowed);
}

void check_steel(const SceneFile& file) {
  for (const Material& material : file.scene.materials) {
    const auto* law = std::get_if<Steel>(&material.law);
    if (law == nullptr || law->strength.room_temperature < law->strength.melting_temperature) continue;
    const std::string table = material.name == Steel::name ? "" : "material." + material.name + ".";
    throw fault_at(
        file, (table.empty() ? "steel." : table) + "melting_temperature",
        fmt::format("{:.6g} K", law->strength.melting_temperature),
        fmt::format("a temperature above the room temperature, {:.6g} K", law->strength.room_temperature));
  }
}

void check_gaps(const SceneFile& file) {
  std::vector<double> gaps = file.scene.surface.gaps;
  std::ranges::sort(gaps);
  const auto twice =
      std::ranges::adjacent_find(gaps, [](double a, double b) { return b - a <= 1e-9 * std::max(b, 1e-6); });
  if (twice != gaps.end())
    throw fault_at(file, "gap.thickness", fmt::format("{} twice", length_text(*twice)), "each gap once");
  if (!gaps.empty() && gaps.back() > 0.0 && !has_charge(file.scene))
    throw fault_at(file, "gap.thickness",
                   fmt::format("a gap of {} in a scene without a charge", length_text(gaps.back())),
                   "gaps only under a body of material \"charge\"");
}

/// Of stations: more are no place that anybody looks at, and take minutes to plan.
constexpr double most_stations = 1000;

/// The stations that nothing is said of are as wide as a charge that is narrower, and end with a shorter one.
void check_stations(const SceneFile& file) {
  if (!has_charge(file.scene)) return;
  const Extent charge = charge_extent(file.scene);
  const double narrowest = (charge.r_end - charge.r_begin) / most_stations;
  if (!(file.scene.surface.station_width >= narrowest))
    throw fault_at(file, "station.width", length_text(file.scene.surface.station_width),
                   fmt::format("at least {}, with which {:g} stations tile the charge's bottom",
                               length_text(narrowest), most_stations));
  const Surface& surface = file.scene.surface;
  const Surface usual;
  for (const auto& [key, given, preset, largest, what] :
       {std::tuple{"station.width", surface.station_width, usual.station_width, charge.r_end - charge.r_begin,
                   "width"},
        std::tuple{"station.depth", surface.station_depth, usual.station_depth, charge.x_end - charge.x_begin,
                   "length"}}) {
    const bool is_usual = given >= preset && given <= preset;
    if (is_usual || given <= largest + length_tolerance(file.scene)) continue;
    throw fault_at(file, key, length_text(given),
                   fmt::format("at most the charge's {}, {}", what, length_text(largest)));
  }
}

/// m. Observation points read the skin of the charge's bottom.
constexpr double largest_point_depth = 10e-3;

void check_observation_points(const SceneFile& file) {
  const Scene& scene = file.scene;
  const double tolerance = length_tolerance(scene);
  const Extent charge = charge_extent(scene);
  for (const ObservationPoint& point : scene.output.observation_points) {
    const auto within = [&](double place, double begin, double end) {
      return place >= begin - tolerance && place <= end + tolerance;
    };
    const bool in_charge = std::ranges::any_of(scene.bodies, [&](const Body& body) {
      return is_charge(scene, body) && within(point.x, body.x_begin, body.x_end) &&
             within(point.r, body.r_begin, body.r_end);
    });
    const std::string key = "observation_point." + point.name;
    if (in_charge && charge.x_end - point.x > largest_point_depth + tolerance)
      throw fault_at(file, key + ".x", length_text(point.x),
                     fmt::format("at most {} from the charge's bottom, whose temperatures it reads",
                                 length_text(largest_point_depth)));
    if (in_charge) continue;
    throw fault_at(file, key + (within(point.x, charge.x_begin, charge.x_end) ? ".r" : ".x"),
                   fmt::format("x {}, r {}", length_text(point.x), length_text(point.r)),
                   has_charge(scene) ? fmt::format("a point in the charge, x {}, r {}",
                                                   range_text(charge.x_begin, charge.x_end),
                                                   range_text(charge.r_begin, charge.r_end))
                                     : "none: the scene has no charge");
  }
}

void check_coupling(const SceneFile& file) {
  const Scene& scene = file.scene;
  if (scene.coupling == Coupling::one_way) return;
  if (!has_charge(scene))
    throw fault_at(file, "coupling", "two-way in a scene without a charge", "one-way, or a charge");
  // Particles of an even grid do not grow with their gas: the energy of a column of charge drifted by 2 % in
  // the published release of heat, where the lattice at rest has 1e-7, and by more than 5 % in the full one.
  if (scene.numerics.formulation == Formulation::updated_lagrangian)
    throw fault_at(
        file, "coupling", "two-way with numerics.formulation = \"updated-lagrangian\"",
        "one-way, or the formulation \"total-lagrangian\", whose energy balances while gas expands");
}

void check_output(const SceneFile& file) {
  const double duration = end_time(file.scene.load);
  const std::string until = time_text(duration);
  if (file.scene.output.trace_interval > duration)
    throw fault_at(file, "output.trace_interval", time_text(file.scene.output.trace_interval),
                   "an interval of at most the load's duration, " + until);
  std::vector<double> times = file.scene.output.snapshot_times;
  std::ranges::sort(times);
  if (const auto twice = std::ranges::adjacent_find(times); twice != times.end())
    throw fault_at(file, "output.snapshots", time_text(*twice) + " twice", "each time once");
  const bool burns = file.scene.coupling == Coupling::two_way;
  const double last = burns ? duration + file.scene.combustion.duration : duration;
  for (const double time : times) {
    if (time <= last * (1.0 + 1e-12)) continue;
    throw fault_at(file, "output.snapshots", time_text(time),
                   burns ? "times from 0 ms to combustion.duration after the load's end, " + time_text(last)
                         : "times from 0 ms to the load's duration, " + until);
  }
}

}  // namespace

void validate(const SceneFile& file) {
  for (const auto check :
       {check_names, check_near_edges, check_overlaps, check_support, check_interfaces, check_stations,
        check_cell_size, check_load, check_kinetics, check_equation_of_state, check_steel, check_gaps,
        check_observation_points, check_formulation, check_coupling, check_output})
    check(file);
}

}  // namespace launchsafe::scene
