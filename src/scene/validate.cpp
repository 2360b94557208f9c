// What a scene must satisfy beyond the range of each key, before anything is computed.
#include "scene_file.hpp"

#include <set>

namespace launchsafe::scene {
namespace {

template <class Owner>
void check_names_of(const SceneFile& file, const std::string& table, const std::vector<Owner>& owners) {
  std::set<std::string> names;
  for (const Owner& owner : owners)
    if (owner.name.empty() || !names.insert(owner.name).second)
      throw fault_at(file, table + "." + owner.name + ".name",
                     fmt::format("\"{}\" {}", owner.name, owner.name.empty() ? "without letters" : "twice"),
                     "a name that no other has");
}

void check_names(const SceneFile& file) {
  if (file.scene.bodies.empty())
    throw fault_at(file, "body", "no body", "at least one [[body]] with name, material, x and r");
  check_names_of(file, "body", file.scene.bodies);
  check_names_of(file, "observation_point", file.scene.output.observation_points);
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
                 fmt::format("{}, with which the body \"{}\" has no particle of the mesh", length_text(cell),
                             thinnest.name),
                 fmt::format("at most {} for this body", length_text(largest)));
}

/// Something that two keys together make impossible.
struct Conflict {
  bool is_there = false;
  std::string key, found, allowed;
};

/// What only one of the formulations has is refused with the other, so that nobody believes it at work.
/// Particles of an even grid do not grow with their gas, so that their energy drifts in combustion.
std::vector<Conflict> conflicts_of(const Scene& scene) {
  const Numerics& numerics = scene.numerics;
  const bool even = numerics.formulation == Formulation::updated_lagrangian, charge = has_charge(scene);
  const bool couples = scene.coupling == Coupling::two_way;
  const auto& kinetics = scene.charge().kinetics;
  const auto& strength = scene.steel().strength;
  const std::string only = "1 with formulation \"updated-lagrangian\"";
  const auto kelvin = [](double temperature) { return fmt::format("{:.6g} K", temperature); };
  const double end = end_time(scene.load),
               gap = scene.surface.gaps.empty() ? 0.0 : std::ranges::max(scene.surface.gaps);
  return {
      {kinetics.ignition_temperature >= kinetics.burnt_temperature, "kinetics.ignition_temperature",
       kelvin(kinetics.ignition_temperature),
       "a temperature below kinetics.burnt_temperature, " + kelvin(kinetics.burnt_temperature)},
      {scene.initial_temperature >= kinetics.ignition_temperature, "kinetics.ignition_temperature",
       kelvin(kinetics.ignition_temperature),
       "a temperature above the initial " + kelvin(scene.initial_temperature)},
      {strength.room_temperature >= strength.melting_temperature, "steel.melting_temperature",
       kelvin(strength.melting_temperature),
       "a temperature above the room temperature, " + kelvin(strength.room_temperature)},
      {gap > 0.0 && !charge, "gap.thickness", length_text(gap) + " in a scene without a charge",
       "gaps only under a body of material \"charge\""},
      {even && numerics.growth_x > 1.0, "numerics.growth_x", fmt::format("{:g}", numerics.growth_x), only},
      {even && numerics.growth_r > 1.0, "numerics.growth_r", fmt::format("{:g}", numerics.growth_r), only},
      {even && numerics.selective_inertia > 1.0, "numerics.selective_inertia",
       fmt::format("{:g}", numerics.selective_inertia), only},
      {couples && !charge, "coupling", "two-way in a scene without a charge", "one-way, or a charge"},
      {couples && even, "coupling", "two-way with numerics.formulation = \"updated-lagrangian\"",
       "one-way, or the formulation \"total-lagrangian\""},
      {scene.output.trace_interval > end, "output.trace_interval", time_text(scene.output.trace_interval),
       "an interval of at most the load's duration, " + time_text(end)},
  };
}

void check_conflicts(const SceneFile& file) {
  for (const Conflict& each : conflicts_of(file.scene))
    if (each.is_there) throw fault_at(file, each.key, each.found, each.allowed);
}

void check_equation_of_state(const SceneFile& file) {
  const auto fault = materials::fault_of(file.scene.charge().eos);
  if (!fault) return;
  const auto given = std::ranges::find_if(
      fault->keys, [&](const std::string& key) { return file.given.contains("charge." + key); });
  throw fault_at(file, "charge." + (given != fault->keys.end() ? *given : fault->keys.front()), fault->found,
                 fault->allowed);
}

void check_interfaces(const SceneFile& file) {
  const std::vector<std::string> touching = bodies_at_the_charge(file.scene);
  for (const Interface& faces : file.scene.interfaces) {
    const std::string table = "interface." + faces.body;
    // Faces that constants or studies hold have no place of their own.
    const auto refuse = [&](const std::string& key, const std::string& found, const std::string& allowed) {
      const std::string at = file.places.contains(table + key) ? key : ".condition";
      throw error_at(place_of_key(file, table + at), table + key, found, allowed);
    };
    if (!contains(touching, faces.body)) {
      const std::string nearest = nearest_of(faces.body, touching);
      throw fault_at(file, table, "no body that touches the charge",
                     touching.empty() ? "no interface: no body touches a charge" : quoted_list(touching),
                     nearest.empty() ? nearest : "interface." + nearest);
    }
    if (can_slide(faces) && !faces.friction)
      refuse(".friction", "nothing: faces that slide without their friction",
             fmt::format("a friction from 0 (smooth) to {:g}", largest_friction));
    if (faces.friction && !can_slide(faces))
      refuse(".friction", "friction on bonded faces", "friction with condition = \"sliding\"");
    if (can_slide(faces) && file.scene.numerics.formulation == Formulation::updated_lagrangian)
      refuse(".condition", "faces that can slide with formulation \"updated-lagrangian\"",
             "bonded faces, or numerics.formulation = \"total-lagrangian\"");
  }
}

void check_stations(const SceneFile& file) {
  constexpr double most = 1000;  // more are no place that anybody looks at, and take minutes to plan
  if (!has_charge(file.scene)) return;
  const Extent charge = charge_extent(file.scene);
  const Surface &surface = file.scene.surface, usual;
  const double width = charge.r_end - charge.r_begin, length = charge.x_end - charge.x_begin;
  const double tolerance = length_tolerance(file.scene);
  // The stations that nothing is said of are as wide as a charge that is narrower.
  if (surface.station_width < width / most ||
      (surface.station_width != usual.station_width && surface.station_width > width + tolerance))
    throw fault_at(
        file, "station.width", length_text(surface.station_width),
        fmt::format("{} to the charge's width, {}", length_text(width / most), length_text(width)));
  if (surface.station_depth != usual.station_depth && surface.station_depth > length + tolerance)
    throw fault_at(file, "station.depth", length_text(surface.station_depth),
                   "at most the charge's length, " + length_text(length));
}

void check_observation_points(const SceneFile& file) {
  constexpr double largest_depth = 10e-3;  // m; points read the skin of the charge's bottom
  const Scene& scene = file.scene;
  const double tolerance = length_tolerance(scene), bottom = charge_extent(scene).x_end;
  for (const ObservationPoint& point : scene.output.observation_points) {
    const auto within = [&](double place, double begin, double end) {
      return place >= begin - tolerance && place <= end + tolerance;
    };
    const bool in_charge = std::ranges::any_of(scene.bodies, [&](const Body& body) {
      return is_charge(scene, body) && within(point.x, body.x_begin, body.x_end) &&
             within(point.r, body.r_begin, body.r_end);
    });
    const bool is_deep = !within(point.x, bottom - largest_depth, bottom);
    if (in_charge && !is_deep) continue;
    throw fault_at(file, "observation_point." + point.name + (is_deep ? ".x" : ".r"),
                   fmt::format("x {}, r {}", length_text(point.x), length_text(point.r)),
                   fmt::format("a place in the charge within {} of its bottom, x {}",
                               length_text(largest_depth), length_text(bottom)));
  }
}

/// Gaps and times of snapshots, each once; a snapshot within the run.
void check_lists(const SceneFile& file) {
  const Scene& scene = file.scene;
  const auto check_twice = [&](const char* key, std::vector<double> values, Dimension dimension) {
    std::ranges::sort(values);
    const auto twice = std::ranges::adjacent_find(
        values, [](double a, double b) { return b - a <= 1e-9 * std::max(b, 1e-6); });
    if (twice != values.end())
      throw fault_at(file, key, format_quantity(*twice, dimension) + " twice", "each value once");
  };
  check_twice("gap.thickness", scene.surface.gaps, Dimension::length);
  check_twice("output.snapshots", scene.output.snapshot_times, Dimension::time);
  const double burns = scene.coupling == Coupling::two_way ? scene.combustion.duration : 0.0;
  const double last = end_time(scene.load) + burns;
  for (const double time : scene.output.snapshot_times)
    if (time > last * (1.0 + 1e-12))
      throw fault_at(file, "output.snapshots", time_text(time),
                     "times from 0 ms to the end of the run, " + time_text(last));
}

}  // namespace

std::vector<InterfaceText> describe_interfaces(const Scene& scene) {
  std::vector<InterfaceText> described;
  for (const std::string& body : bodies_at_the_charge(scene)) {
    const auto faces = std::ranges::find(scene.interfaces, body, &Interface::body);
    if (faces == scene.interfaces.end() || !can_slide(*faces))
      described.push_back(
          {body, "bonded", "charge and body never part or slide, and the bond bears any tension and shear"});
    else
      described.push_back(
          {body, "sliding",
           fmt::format("Coulomb's friction {:g} on the pressure of the same instant, no tension, faces may "
                       "part; the heat of friction is told and heats no skin",
                       faces->friction.value_or(0.0))});
  }
  return described;
}

void validate(const SceneFile& file) {
  for (const auto check :
       {check_names, check_geometry, check_interfaces, check_stations, check_cell_size, check_load,
        check_conflicts, check_equation_of_state, check_observation_points, check_lists})
    check(file);
}

}  // namespace launchsafe::scene
