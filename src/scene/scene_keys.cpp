
#include "launchsafe/scene/constants.hpp"
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

using Keys = std::vector<Key<Scene>>;

/// What the scene's first material of a law is, for people.
template <class Law>
Key<Scene> title_key() {
  return text_key<Scene>(
             fmt::format("{}.title", Law::name), Standing::assumed, "What the material is, for reports.",
             "PBX 9501", [](auto& scene) -> auto& { return scene.template material<Law>().title; }) |
         written_where([](const Scene& scene) { return !scene.material<Law>().title.empty(); }) |
         acting_on(ActsOn::nothing);
}

/// The keys of a law as those of the scene's first material of it.
template <class Law>
Keys keys_of_law() {
  Keys keys = keys::keys_of_part<Scene>(
      "", [](auto& scene) -> auto& { return scene.template parameters<Law>(); }, Law::parameters());
  if (!Law::always_written) {
    for (Key<Scene>& key : keys)
      key.is_written = [get = key.get, usual = key.default_value()](const Scene& scene) {
        return has_law<Law>(scene) || get(scene) != usual;
      };
  }
  keys.push_back(title_key<Law>());
  return keys;
}

Keys keys_of_laws() {
  Keys keys;
  materials::for_each_law([&keys]<class Law>(const Law&) {
    keys = keys::joined({keys, keys_of_law<Law>()});
  });
  return keys;
}

bool couples_back(const Scene& scene) { return scene.coupling == Coupling::two_way; }

Keys general_keys() {
  return {
      text_key("title", Standing::assumed, "What this scene is, for reports.", "155 mm shell, Composition B",
               &Scene::title) |
          acting_on(ActsOn::nothing),
      word_key("barrel", Standing::assumed,
               "Frictionless rigid barrel around the outer surface, or a free outer surface.",
               {{"rigid", Barrel::rigid}, {"none", Barrel::none}}, &Scene::barrel),
      flag_key("open_charge", Standing::assumed,
               "Whether the charge may have a front, or a step, that no body covers all over.",
               &Scene::open_charge) |
          written_where([](const Scene& scene) { return scene.open_charge; }),
      number_key("initial_temperature", Dimension::temperature, between(200, 500), Standing::paper,
                 "Temperature of all bodies and of the gap's air before launch.",
                 &Scene::initial_temperature) |
          then([](Scene& s) {
            materials::AirParameters& air = s.surface.air;
            air.initial_temperature = s.initial_temperature;
            air.density = materials::air_density(air.initial_temperature, air.initial_pressure);
          }),
      word_key("coupling", Standing::assumed,
               "Whether the run of a gap that ignites goes on through combustion, with burning "
               "explosive turned to gas that acts on charge and shell, or ends with the launch.",
               {{"one-way", Coupling::one_way}, {"two-way", Coupling::two_way}}, &Scene::coupling) |
          written_where(couples_back) | acting_on(ActsOn::combustion),
  };
}

std::vector<Key<Combustion>> combustion_keys() {
  return {
      number_key("duration", Dimension::time, above_to(0, 1), Standing::assumed,
                 "Time after the first ignition at which the run ends.", &Combustion::duration),
      number_key("stop_pressure", Dimension::pressure, above_to(0, 1e11), Standing::assumed,
                 "Pressure at the charge's bottom at which the run ends before.", &Combustion::stop_pressure),
  };
}

std::vector<Key<Numerics>> numerics_keys() {
  return {
      word_key("formulation", Standing::assumed,
               "Gradients on the lattice at rest, whose lines run through all edges of "
               "bodies, or uGIMP on an even background grid (the paper's method).",
               {{"total-lagrangian", Formulation::total_lagrangian},
                {"updated-lagrangian", Formulation::updated_lagrangian}},
               &Numerics::formulation),
      number_key("cell_size", Dimension::length, between(1e-5, 1), Standing::assumed,
                 "Largest cell length at the charge's bottom and sides, and everywhere on an even grid; the "
                 "grid is fitted to the bodies with cells no longer than this.",
                 &Numerics::cell_size),
      number_key("growth_x", Dimension::number, between(1, 1.5), Standing::assumed,
                 "Ratio of neighbouring cells along x away from the charge's bottom; 1 is an even grid.",
                 &Numerics::growth_x),
      number_key("growth_r", Dimension::number, between(1, 1.5), Standing::assumed,
                 "Ratio of neighbouring cells along r away from the charge's sides; 1 is an even grid.",
                 &Numerics::growth_r),
      number_key("largest_cell", Dimension::length, between(1e-5, 1), Standing::assumed,
                 "Length up to which cells grow; along r no further than station.width.",
                 &Numerics::largest_cell),
      number_key("hourglass_stiffness", Dimension::number, between(0.03, 1), Standing::assumed,
                 "Stiffness against hourglassing with one particle a cell, as a share of the shear "
                 "stiffness, in a charge of a fifth of it.",
                 &Numerics::hourglass_stiffness),
      number_key("particles_per_cell", Dimension::count, between(1, 4), Standing::assumed,
                 "Particles per cell in each direction.", &Numerics::particles_per_cell),
      number_key("time_step_factor", Dimension::number, above_to(0, 2), Standing::assumed,
                 "Time step over the time sound takes through a cell (CFL); steps are proved "
                 "stable up to 0.68, updated-Lagrangian ones up to 0.57.",
                 &Numerics::time_step_factor),
      number_key("inertial_scaling", Dimension::number, between(1, 1e4), Standing::assumed,
                 "Factor on the inertia of the motion relative to the accelerating frame; an accuracy knob.",
                 &Numerics::inertial_scaling),
      number_key("selective_inertia", Dimension::number, between(1, 8), Standing::assumed,
                 "Multiple of the step that the smallest cells allow; cells that allow less "
                 "get the inertia for it (selective mass scaling). 1 is true inertia.",
                 &Numerics::selective_inertia) |
          usually(
              "4, or 1 where that was not measured: two-way coupling, measured curves, rises below 0.5 ms, "
              "other scaled inertia, no charge, updated-Lagrangian"),
      number_key("damping_time", Dimension::time, between(0, 1), Standing::assumed,
                 "Decay time of the relative velocity; \"0 ms\" for no damping.", &Numerics::damping_time),
      number_key("pic_fraction", Dimension::number, between(0, 0.2), Standing::assumed,
                 "Share of PIC in the velocity update; 0 is pure FLIP.", &Numerics::pic_fraction),
      number_key("energy_drift_limit", Dimension::number, above_to(0, 100), Standing::assumed,
                 "Energy drift, as a share of the energy scale, past which a run is indeterminate.",
                 &Numerics::energy_drift_limit),
  };
}

std::vector<Key<Output>> output_keys() {
  return {
      number_key("trace_interval", Dimension::time, above_to(0, 2e-3), Standing::assumed,
                 "Interval between samples of the bottom trace.", &Output::trace_interval) |
          acting_on(ActsOn::numerics),
      list_key("snapshots", Dimension::time, between(0, 1), Standing::assumed,
               "Times at which the fields of all particles are stored.", &Output::snapshot_times) |
          may_be_empty(),
      words_key("snapshot_events", Standing::assumed, "Events at which they are stored too; empty for none.",
                event_words(), &Output::snapshot_events) |
          written_where([](const Output& output) { return !output.snapshot_events.empty(); }),
  };
}

std::vector<Key<Surface>> gap_keys() {
  return {
      list_key("thickness", Dimension::length, between(0, 0.01), Standing::paper,
               "Gaps between charge and base; all are judged on one run of the mechanics.", &Surface::gaps),
      number_key("skin_thickness", Dimension::length, above_to(0, 0.01), Standing::paper,
                 "Thickness of the charge's skin that the air heats.", &Surface::skin_thickness),
      number_key("exchange_time", Dimension::time, above_to(0, 1), Standing::calibrated,
                 "Time constant of the exchange between air and skin.", &Surface::exchange_time),
  };
}

std::vector<Key<materials::AirParameters>> air_keys() {
  using materials::AirParameters;
  return {
      number_key("specific_heat", Dimension::specific_heat, between(950, 1.2e3), Standing::literature,
                 "Specific heat of the air.", &AirParameters::specific_heat),
      number_key("heat_ratio", Dimension::number, between(1.3, 1.42), Standing::paper,
                 "Adiabatic exponent of the air.", &AirParameters::heat_ratio),
      number_key("pressure", Dimension::pressure, between(80e3, 150e3), Standing::assumed,
                 "Pressure of the air before launch; its density follows by the gas law.",
                 &AirParameters::initial_pressure) |
          then([](AirParameters& air) {
            air.density = materials::air_density(air.initial_temperature, air.initial_pressure);
          }) |
          acting_on(ActsOn::trace),
  };
}

std::vector<Key<Surface>> friction_keys() {
  std::vector<std::pair<std::string, FrictionClosure>> words;
  for (const auto closure : {FrictionClosure::total_strain_rate, FrictionClosure::none})
    words.emplace_back(word_of(closure), closure);
  return {
      word_key("closure", Standing::assumed,
               "Strain rate that the sliding friction acts on: the total one, or none.", words,
               &Surface::friction) |
          acting_on(ActsOn::heat),
      number_key("localisation", Dimension::number, between(0, 1e6), Standing::calibrated,
                 "Crack spacing over the thickness of the sliding layer: factor on the friction heat.",
                 &Surface::localisation) |
          acting_on(ActsOn::surface),
  };
}

std::vector<Key<Surface>> station_keys() {
  return {
      number_key("width", Dimension::length, between(1e-3, 0.03), Standing::assumed,
                 "Width of the stations that tile the charge's bottom, rounded so that a whole "
                 "number of them does; skin temperatures and verdicts are theirs.",
                 &Surface::station_width),
      number_key("depth", Dimension::length, between(1e-3, 0.03), Standing::assumed,
                 "Depth from the bottom over which stations average pressure and strain.",
                 &Surface::station_depth),
  };
}

/// Those of the charge's bottom: gap and air, friction and stations.
Keys surface_keys() {
  using keys::keys_of_part;
  return keys::joined({keys_of_part("gap.", &Scene::surface, acting_on(ActsOn::surface, gap_keys())),
                       keys_of_part<Scene>(
                           "gap.air_", [](auto& scene) -> auto& { return scene.surface.air; },
                           acting_on(ActsOn::surface, air_keys())),
                       keys_of_part("friction.", &Scene::surface, friction_keys()),
                       keys_of_part("station.", &Scene::surface, station_keys())});
}

std::vector<Key<Physics>> physics_keys() {
  const std::vector<std::pair<std::string, Switch>> switches{
      {"auto", Switch::automatic}, {"on", Switch::on}, {"off", Switch::off}};
  return {
      word_key("conduction", Standing::assumed,
               "Heat conduction between particles: as the plan decides, or forced.", switches,
               &Physics::conduction),
      word_key("bulk_reaction", Standing::assumed,
               "Reaction heat in the bulk of the charge: as the plan decides, or forced.", switches,
               &Physics::bulk_reaction),
  };
}

/// They do nothing, and are no part of what identifies a run, without two-way coupling.
Keys written_combustion_keys() {
  Keys keys =
      keys::keys_of_part("combustion.", &Scene::combustion, acting_on(ActsOn::combustion, combustion_keys()));
  for (Key<Scene>& key : keys) written_where(couples_back)(key);
  return keys;
}

template <class Owner>
void document(std::vector<DocumentedKey>& documented, const std::vector<Key<Owner>>& keys,
              const std::string& prefix) {
  for (const Key<Owner>& key : keys) {
    // What only the user can say has no default, even where it may be left out.
    const bool no_default = key.required || key.standing == Standing::input;
    DocumentedKey entry{key, no_default ? std::string{} : format_value(key, key.default_value())};
    if (!key.usual.empty()) entry.default_text = key.usual;
    entry.description.name = prefix + key.name;
    documented.push_back(std::move(entry));
  }
}

}  // namespace

const std::vector<std::string>& event_words() {
  static const std::vector<std::string> words{"peak-pressure", "ignition"};
  return words;
}

const std::vector<Key<Scene>>& scene_keys() {
  using keys::keys_of_part;
  static const Keys keys = keys::joined(
      {general_keys(), keys_of_part("load.", &Scene::load, load_keys()), keys_of_laws(), surface_keys(),
       keys_of_part("numerics.", &Scene::numerics, acting_on(ActsOn::numerics, numerics_keys())),
       keys_of_part("output.", &Scene::output, output_keys()),
       keys_of_part("physics.", &Scene::physics, physics_keys()), written_combustion_keys()});
  return keys;
}

ActsOn acts_on(std::string_view scene_key) {
  const Key<Scene>* found = find_key(scene_keys(), scene_key);
  return found == nullptr ? ActsOn::mechanics : found->acts_on;
}

const std::vector<Key<Body>>& body_keys() {
  static const std::vector<Key<Body>> keys = {
      text_key("name", Standing::input, "Name of the body, unique.", "wall", &Body::name) | required() |
          acting_on(ActsOn::nothing),
      text_key("material", Standing::input,
               "What the body is made of: a law, whose table gives the numbers, or a material by name.",
               "comp-b", &Body::material) |
          required(),
      range_key("x", Dimension::length, between(0, 10), Standing::input,
                "Axial extent, from the nose to the base.", &Body::x_begin, &Body::x_end) |
          required(),
      range_key("r", Dimension::length, between(0, 10), Standing::input,
                "Radial extent, from the axis outward.", &Body::r_begin, &Body::r_end) |
          required(),
  };
  return keys;
}

const std::vector<Key<Interface>>& interface_keys() {
  static const std::vector<Key<Interface>> keys = {
      word_key("condition", Standing::input,
               "How a body and the charge hold each other: bonded, or sliding with friction, "
               "free to part. Bodies without a table are held as the constants say.",
               {{"bonded", Condition::bonded}, {"sliding", Condition::sliding}}, &Interface::condition) |
          required(),
      number_key(
          "friction", Dimension::number, between(0, largest_friction), Standing::input,
          "Coulomb's coefficient between the faces; to be given where they can slide, 0 for smooth ones.",
          &Interface::friction),
  };
  return keys;
}

const std::vector<Key<ObservationPoint>>& observation_point_keys() {
  static const std::vector<Key<ObservationPoint>> keys = {
      text_key("name", Standing::input, "Name of the point, unique.", "G2", &ObservationPoint::name) |
          required(),
      number_key("x", Dimension::length, between(0, 10), Standing::input, "Axial position at rest.",
                 &ObservationPoint::x) |
          required(),
      number_key("r", Dimension::length, between(0, 10), Standing::input, "Radial position at rest.",
                 &ObservationPoint::r) |
          required(),
  };
  return keys;
}

std::vector<DocumentedKey> describe_keys() {
  std::vector<DocumentedKey> documented;
  KeyDescription constants =
      keys::description("constants", KeyKind::text, Standing::input,
                        "Constants that were fitted, of every key that the scene does not state: a shipped "
                        "name, the path of a constants file, or none.");
  constants.example = default_constants;
  documented.push_back({std::move(constants), default_constants});
  document(documented, scene_keys(), "");
  document(documented, body_keys(), "body.");
  document(documented, interface_keys(), "interface.NAME.");
  document(documented, observation_point_keys(), "observation_point.");
  return documented;
}

}  // namespace launchsafe::scene
