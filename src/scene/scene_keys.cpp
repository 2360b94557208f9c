#include "launchsafe/scene/scene_keys.hpp"

#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/pressure_curve.hpp"
#include "plausible_ranges.hpp"

#include <iterator>
#include <utility>

namespace launchsafe::scene {
namespace {

using Keys = std::vector<Key<Scene>>;

/// A key of a law as one of the scene.
template <class Law>
Key<Scene> key_of_law(const Key<Law>& key) {
  Key<Scene> own{static_cast<const KeyDescription&>(key), {}, {}};
  own.set = [set = key.set](Scene& scene, const Value& value) { set(scene.parameters<Law>(), value); };
  own.get = [get = key.get](const Scene& scene) { return get(scene.parameters<Law>()); };
  if (!Law::always_written)
    own.is_written = [get = own.get, usual = key.default_value()](const Scene& scene) {
      return has_law<Law>(scene) || get(scene) != usual;
    };
  return own;
}

Keys material_keys() {
  Keys keys;
  materials::for_each_law([&keys]<class Law>(const Law&) {
    for (const Key<Law>& key : Law::parameters()) keys.push_back(key_of_law(key));
  });
  return keys;
}

std::vector<std::string> names_of_materials() {
  std::vector<std::string> names;
  for (const Material& material : usual_materials()) names.push_back(material.name);
  return names;
}

/// The material of a body, by name.
Key<Body> material_key() {
  Key<Body> key = text_key<Body>(
      "material", Standing::input, "What the body is made of.", [](auto& b) -> auto& { return b.material; });
  key.kind = KeyKind::word;
  key.words = names_of_materials();
  return key;
}

Keys general_keys() {
  return {
      text_key<Scene>(
          "title", Standing::assumed, "What this scene is, for reports.",
          [](auto& s) -> auto& { return s.title; }),
      word_key<Scene, Symmetry>(
          "symmetry", Standing::paper, "Full shell of revolution, or a slice of unit depth (half model).",
          {{"axisymmetric", Symmetry::axisymmetric}, {"plane-strain", Symmetry::plane_strain}},
          [](auto& s) -> auto& { return s.symmetry; }),
      word_key<Scene, Frame>(
          "frame", Standing::assumed,
          "Grid that accelerates with the projectile, or a grid at rest that it flies through.",
          {{"co-moving", Frame::co_moving}, {"lab", Frame::lab}}, [](auto& s) -> auto& { return s.frame; }),
      word_key<Scene, Barrel>(
          "barrel", Standing::assumed,
          "Frictionless rigid barrel around the outer surface, or a free outer surface.",
          {{"rigid", Barrel::rigid}, {"none", Barrel::none}}, [](auto& s) -> auto& { return s.barrel; }),
      then(number_key<Scene>(
               "initial_temperature", Dimension::temperature, between(200, 500), Standing::paper,
               "Temperature of all bodies and of the gap's air before launch.",
               [](auto& s) -> auto& { return s.initial_temperature; }),
           [](Scene& s) { s.surface.air.initial_temperature = s.initial_temperature; }),
  };
}

Keys load_keys() {
  return {
      number_key<Scene>(
          "load.duration", Dimension::time, above_to(0, 1), Standing::paper,
          "Simulated time, from the ignition of the propellant on.",
          [](auto& s) -> auto& { return s.load.duration; }),
      number_key<Scene>(
          "load.peak", Dimension::pressure, above_to(0, 10e9), Standing::paper, "Largest chamber pressure.",
          [](auto& s) -> auto& { return s.load.peak; }),
      number_key<Scene>(
          "load.base", Dimension::pressure, between(0, 10e9), Standing::assumed,
          "Chamber pressure at the start.", [](auto& s) -> auto& { return s.load.base; }),
      number_key<Scene>(
          "load.peak_time", Dimension::time, above_to(0, 1), Standing::assumed,
          "Time of the largest chamber pressure.", [](auto& s) -> auto& { return s.load.peak_time; }),
      number_key<Scene>(
          "load.exponent", Dimension::number, above_to(0, 1000), Standing::assumed,
          "Steepness n of base + (peak - base) ((t/peak_time) exp(1 - t/peak_time))^n.",
          [](auto& s) -> auto& { return s.load.exponent; }),
      // The points of a measured curve are written back; the file they came from need not exist any more.
      written_where<Scene>(
          overriding(text_key<Scene>(
                         "load.curve", Standing::assumed,
                         "Measured curve that replaces the analytic shape: a CSV file beside "
                         "the scene, with a header such as time_ms,pressure_MPa; empty for none.",
                         [](auto& s) -> auto& { return s.load.curve_file; }),
                     {"load.curve_time", "load.curve_pressure"}),
          [](const Scene&) { return false; }),
      may_be_empty(list_key<Scene>(
          "load.curve_time", Dimension::time, between(-largest_curve_time, largest_curve_time),
          Standing::assumed, "Times of a measured curve written in the scene itself, increasing.",
          [](auto& s) -> auto& { return s.load.curve_time; })),
      may_be_empty(list_key<Scene>(
          "load.curve_pressure", Dimension::pressure, between(0, largest_load), Standing::assumed,
          "Pressures of a measured curve written in the scene itself.",
          [](auto& s) -> auto& { return s.load.curve_pressure; })),
      flag_key<Scene>(
          "load.rescale_to_peak", Standing::assumed,
          "Scale the measured curve, after smoothing, so that its largest pressure is load.peak.",
          [](auto& s) -> auto& { return s.load.rescale_to_peak; }),
      written_where<Scene>(number_key<Scene>(
                               "load.smoothing", Dimension::time, between(0, 1), Standing::assumed,
                               "Window over which a measured curve is averaged against noise, which heats "
                               "falsely; it takes from narrow peaks; \"0 ms\" for none.",
                               [](auto& s) -> auto& { return s.load.smoothing; }),
                           [](const Scene& s) { return s.load.smoothing != 0.0; }),
  };
}

Keys gap_keys() {
  return {
      list_key<Scene>(
          "gap.thickness", Dimension::length, between(0, 0.01), Standing::paper,
          "Gaps between charge and base; all are judged on one run of the mechanics.",
          [](auto& s) -> auto& { return s.surface.gaps; }),
      word_key<Scene, AirPressure>(
          "gap.pressure", Standing::assumed,
          "What compresses the air: the charge's bottom stress or the chamber.",
          {{"charge-bottom", AirPressure::charge_bottom}, {"chamber", AirPressure::chamber}},
          [](auto& s) -> auto& { return s.surface.air_pressure; }),
      word_key<Scene, AirModel>(
          "gap.air", Standing::paper,
          "Air that stays on its adiabat, air that loses what the skin gains, or a film that conducts into "
          "charge and base, the optimistic bound; in the film no exchange, skin or air density counts.",
          {{"reservoir", AirModel::reservoir}, {"balance", AirModel::balance}, {"film", AirModel::film}},
          [](auto& s) -> auto& { return s.surface.air_model; }),
      word_key<Scene, Exchange>(
          "gap.exchange", Standing::derived,
          "Heat exchange as a rate, or the printed share in each time step, which depends on it.",
          {{"rate", Exchange::rate}, {"per-step", Exchange::per_step}},
          [](auto& s) -> auto& { return s.surface.exchange; }),
      number_key<Scene>(
          "gap.skin_thickness", Dimension::length, above_to(0, 0.01), Standing::paper,
          "Thickness of the charge's skin that the air heats.",
          [](auto& s) -> auto& { return s.surface.skin_thickness; }),
      number_key<Scene>(
          "gap.exchange_time", Dimension::time, above_to(0, 100), Standing::calibrated,
          "Time constant of the exchange between air and skin.",
          [](auto& s) -> auto& { return s.surface.exchange_time; }),
      number_key<Scene>(
          "gap.air_density", Dimension::density, between(0.01, 100), Standing::literature,
          "Density of the air before launch.", [](auto& s) -> auto& { return s.surface.air.density; }),
      number_key<Scene>(
          "gap.air_specific_heat", Dimension::specific_heat, between(100, 1e4), Standing::literature,
          "Specific heat of the air.", [](auto& s) -> auto& { return s.surface.air.specific_heat; }),
      number_key<Scene>(
          "gap.air_heat_ratio", Dimension::number, above_to(1, 1.67), Standing::paper,
          "Adiabatic exponent of the air.", [](auto& s) -> auto& { return s.surface.air.heat_ratio; }),
      number_key<Scene>(
          "gap.air_temperature", Dimension::temperature, between(200, 500), Standing::paper,
          "Temperature of the air before launch; follows initial_temperature unless given.",
          [](auto& s) -> auto& { return s.surface.air.initial_temperature; }),
      number_key<Scene>(
          "gap.air_pressure", Dimension::pressure, above_to(0, 10e6), Standing::assumed,
          "Pressure of the air before launch.",
          [](auto& s) -> auto& { return s.surface.air.initial_pressure; }),
      word_key<Scene, FrictionClosure>(
          "friction.closure", Standing::assumed,
          "Which strain rate the sliding friction acts on: total, inelastic or none.",
          {{"literal", FrictionClosure::literal},
           {"inelastic", FrictionClosure::inelastic},
           {"none", FrictionClosure::none}},
          [](auto& s) -> auto& { return s.surface.friction; }),
      number_key<Scene>(
          "friction.localisation", Dimension::number, between(0, 1e6), Standing::calibrated,
          "Crack spacing over the thickness of the sliding layer: factor on the friction heat.",
          [](auto& s) -> auto& { return s.surface.localisation; }),
  };
}

Keys station_keys() {
  return {
      number_key<Scene>(
          "station.width", Dimension::length, above_to(0, 1), Standing::assumed,
          "Width of the stations that tile the charge's bottom, rounded so that a whole number of them does; "
          "skin temperatures and verdicts are theirs.",
          [](auto& s) -> auto& { return s.surface.station_width; }),
      number_key<Scene>(
          "station.depth", Dimension::length, above_to(0, 1), Standing::assumed,
          "Depth from the bottom over which stations average pressure and strain.",
          [](auto& s) -> auto& { return s.surface.station_depth; }),
  };
}

Keys numerics_keys() {
  return {
      word_key<Scene, Formulation>(
          "numerics.formulation", Standing::assumed,
          "Gradients on the lattice at rest, whose lines run through all edges of bodies, or uGIMP on an "
          "even "
          "background grid (the paper's method).",
          {{"total-lagrangian", Formulation::total_lagrangian},
           {"updated-lagrangian", Formulation::updated_lagrangian}},
          [](auto& s) -> auto& { return s.numerics.formulation; }),
      number_key<Scene>(
          "numerics.cell_size", Dimension::length, between(1e-5, 1), Standing::assumed,
          "Largest cell length at the refined lines, and everywhere on an even grid; the grid is fitted to "
          "the "
          "bodies with cells no longer than this.",
          [](auto& s) -> auto& { return s.numerics.cell_size; }),
      number_key<Scene>(
          "numerics.growth_x", Dimension::number, between(1, 2), Standing::assumed,
          "Ratio of neighbouring cells along x away from the refined lines; 1 is an even grid.",
          [](auto& s) -> auto& { return s.numerics.growth_x; }),
      number_key<Scene>(
          "numerics.growth_r", Dimension::number, between(1, 2), Standing::assumed,
          "Ratio of neighbouring cells along r away from the refined lines; 1 is an even grid.",
          [](auto& s) -> auto& { return s.numerics.growth_r; }),
      number_key<Scene>(
          "numerics.largest_cell", Dimension::length, between(1e-5, 1), Standing::assumed,
          "Length up to which cells grow; along r no further than station.width.",
          [](auto& s) -> auto& { return s.numerics.largest_cell; }),
      may_be_empty(list_key<Scene>(
          "numerics.refined_x", Dimension::length, between(-10, 10), Standing::assumed,
          "Places along x where cells are smallest; empty for the charge's bottom.",
          [](auto& s) -> auto& { return s.numerics.refined_x; })),
      may_be_empty(list_key<Scene>(
          "numerics.refined_r", Dimension::length, between(0, 10), Standing::assumed,
          "Radii where cells are smallest; empty for the charge's edges.",
          [](auto& s) -> auto& { return s.numerics.refined_r; })),
      number_key<Scene>(
          "numerics.hourglass_stiffness", Dimension::number, between(0, 10), Standing::assumed,
          "Stiffness against hourglassing with one particle a cell, as a share of the shear stiffness, in a "
          "charge of a fifth of it.",
          [](auto& s) -> auto& { return s.numerics.hourglass_stiffness; }),
      number_key<Scene>(
          "numerics.particles_per_cell", Dimension::count, between(1, 16), Standing::assumed,
          "Particles per cell in each direction.",
          [](auto& s) -> auto& { return s.numerics.particles_per_cell; }),
      number_key<Scene>(
          "numerics.time_step_factor", Dimension::number, above_to(0, 2), Standing::assumed,
          "Time step over the time sound takes through a cell (CFL); steps are proved stable up to 0.68, "
          "updated-Lagrangian ones up to 0.57.",
          [](auto& s) -> auto& { return s.numerics.time_step_factor; }),
      number_key<Scene>(
          "numerics.inertial_scaling", Dimension::number, between(1, 1e4), Standing::assumed,
          "Factor on the inertia of the motion relative to the accelerating frame; an accuracy knob.",
          [](auto& s) -> auto& { return s.numerics.inertial_scaling; }),
      number_key<Scene>(
          "numerics.steel_inertia", Dimension::number, between(1, 100), Standing::assumed,
          "Factor on the inertia of what is no charge, beside inertial_scaling; an accuracy knob.",
          [](auto& s) -> auto& { return s.numerics.steel_inertia; }),
      number_key<Scene>(
          "numerics.damping_time", Dimension::time, between(0, 1), Standing::assumed,
          "Decay time of the relative velocity; \"0 ms\" for no damping.",
          [](auto& s) -> auto& { return s.numerics.damping_time; }),
      number_key<Scene>(
          "numerics.pic_fraction", Dimension::number, between(0, 1), Standing::assumed,
          "Share of PIC in the velocity update; 0 is pure FLIP.",
          [](auto& s) -> auto& { return s.numerics.pic_fraction; }),
      number_key<Scene>(
          "numerics.energy_drift_limit", Dimension::number, above_to(0, 100), Standing::assumed,
          "Energy drift, as a share of the energy scale, past which a run is indeterminate.",
          [](auto& s) -> auto& { return s.numerics.energy_drift_limit; }),
  };
}

Keys output_keys() {
  const std::vector<std::pair<std::string, Switch>> switches{
      {"auto", Switch::automatic}, {"on", Switch::on}, {"off", Switch::off}};
  return {
      number_key<Scene>(
          "output.trace_interval", Dimension::time, above_to(0, 1), Standing::assumed,
          "Interval between samples of the bottom trace.",
          [](auto& s) -> auto& { return s.output.trace_interval; }),
      may_be_empty(list_key<Scene>(
          "output.snapshots", Dimension::time, between(0, 1), Standing::assumed,
          "Times at which the fields of all particles are stored.",
          [](auto& s) -> auto& { return s.output.snapshot_times; })),
      word_key<Scene, Switch>(
          "physics.conduction", Standing::assumed,
          "Heat conduction between particles: as the plan decides, or forced.", switches,
          [](auto& s) -> auto& { return s.physics.conduction; }),
      word_key<Scene, Switch>(
          "physics.bulk_reaction", Standing::assumed,
          "Reaction heat in the bulk of the charge: as the plan decides, or forced.", switches,
          [](auto& s) -> auto& { return s.physics.bulk_reaction; }),
      number_key<Scene>(
          "physics.conduction_bound", Dimension::number, at_least(0), Standing::assumed,
          "Diffusion length over cell size below which conduction is left out.",
          [](auto& s) -> auto& { return s.physics.conduction_bound; }),
      number_key<Scene>(
          "physics.reaction_bound", Dimension::temperature_difference, at_least(0), Standing::assumed,
          "Self-heating over the run below which the bulk reaction is left out.",
          [](auto& s) -> auto& { return s.physics.reaction_bound; }),
  };
}

void append(Keys& keys, Keys more) {
  keys.insert(keys.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The keys with what is plausible of each that does not say so itself; `prefix` is that of their names in a
/// whole file.
template <class Owner>
std::vector<Key<Owner>> with_plausible(std::vector<Key<Owner>> keys, const std::string& prefix) {
  for (Key<Owner>& key : keys)
    if (key.plausible.because.empty()) key.plausible = plausible_values_of(prefix + key.name);
  return keys;
}

Keys all_scene_keys() {
  Keys keys = general_keys();
  append(keys, load_keys());
  append(keys, material_keys());
  append(keys, gap_keys());
  append(keys, station_keys());
  append(keys, numerics_keys());
  append(keys, output_keys());
  return with_plausible(std::move(keys), "");
}

template <class Owner>
void document(std::vector<DocumentedKey>& documented, const std::vector<Key<Owner>>& keys,
              const std::string& prefix) {
  for (const Key<Owner>& key : keys) {
    // What only the user can say has no default, even where it may be left out.
    const bool no_default = key.required || key.standing == Standing::input;
    DocumentedKey entry{key, no_default ? std::string{} : format_value(key, key.default_value())};
    entry.description.name = prefix + key.name;
    documented.push_back(std::move(entry));
  }
}

}  // namespace

const std::vector<Key<Scene>>& scene_keys() {
  static const Keys keys = all_scene_keys();
  return keys;
}

const std::vector<Key<Body>>& body_keys() {
  static const std::vector<Key<Body>> keys = with_plausible<Body>(
      {
          required(text_key<Body>(
              "name", Standing::input, "Name of the body, unique.", [](auto& b) -> auto& { return b.name; })),
          required(material_key()),
          required(range_key<Body>(
              "x", Dimension::length, between(0, 10), Standing::input,
              "Axial extent, from the nose to the base.", [](auto& b) -> auto& { return b.x_begin; },
              [](auto& b) -> auto& { return b.x_end; })),
          required(range_key<Body>(
              "r", Dimension::length, between(0, 10), Standing::input,
              "Radial extent, from the axis outward.", [](auto& b) -> auto& { return b.r_begin; },
              [](auto& b) -> auto& { return b.r_end; })),
      },
      "body.");
  return keys;
}

const std::vector<Key<ObservationPoint>>& observation_point_keys() {
  static const std::vector<Key<ObservationPoint>> keys = with_plausible<ObservationPoint>(
      {
          required(text_key<ObservationPoint>(
              "name", Standing::input, "Name of the point, unique.",
              [](auto& p) -> auto& { return p.name; })),
          required(number_key<ObservationPoint>(
              "x", Dimension::length, between(0, 10), Standing::input, "Axial position at rest.",
              [](auto& p) -> auto& { return p.x; })),
          required(number_key<ObservationPoint>(
              "r", Dimension::length, between(0, 10), Standing::input, "Radial position at rest.",
              [](auto& p) -> auto& { return p.r; })),
      },
      "observation_point.");
  return keys;
}

std::vector<DocumentedKey> describe_keys() {
  std::vector<DocumentedKey> documented;
  document(documented, scene_keys(), "");
  document(documented, body_keys(), "body.");
  document(documented, interface_keys(), "interface.NAME.");
  document(documented, observation_point_keys(), "observation_point.");
  document(documented, acceptance_keys(), "accept.");
  return documented;
}

}  // namespace launchsafe::scene
