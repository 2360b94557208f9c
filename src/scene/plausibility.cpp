// What is plausible of keys, and of quantities that follow from several of them.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <boost/math/special_functions/lambert_w.hpp>

namespace launchsafe::scene {
namespace {

bool is_plausible_number(const Plausible& plausible, double number) {
  return (plausible.or_zero && number == 0.0) || plausible.limits.contain(number);
}

bool is_plausible_word(const Plausible& plausible, const std::string& word) {
  return plausible.words.empty() || std::ranges::find(plausible.words, word) != plausible.words.end();
}

/// The value of a key of the scene, which something else than its range makes implausible.
Implausible of_key(const Scene& scene, const std::string& name, std::string range) {
  const Key<Scene>& key = *find_key(scene_keys(), name);
  return implausible(scene.accepted, key, name, key.get(scene), std::move(range));
}

/// A key of a table, its name in the whole scene, and its value if the scene has one.
using VisitKey = std::function<void(const KeyDescription&, const std::string&, const std::optional<Value>&)>;

/// Extents of bodies, what holds the charge, and materials beside those that the keys of the laws speak of.
void visit_keys_of_tables(const Scene& scene, const VisitKey& visit) {
  for (const Body& body : scene.bodies)
    for (const Key<Body>& key : body_keys())
      if (key.kind == KeyKind::range)
        visit(key, fmt::format("body.{}.{}", body.name, key.name), key.get(body));
  for (const Interface& faces : scene.interfaces)
    for (const Key<Interface>& key : interface_keys()) {
      const bool is_written = !key.is_written || key.is_written(faces);
      visit(key, fmt::format("interface.{}.{}", faces.body, key.name),
            is_written ? std::optional(key.get(faces)) : std::nullopt);
    }
  for (const Material& material : used_materials(scene))
    std::visit(
        [&]<class Law>(const Law& law) {
          if (material.name == scene.material<Law>().name) return;
          for (const Key<Law>& key : Law::parameters())
            visit(key, fmt::format("material.{}.{}", material.name, key_in_material(Law::name, key.name)),
                  key.get(law));
        },
        material.law);
}

/// Physics that the plan would have in.
void judge_switches(const Scene& scene, std::vector<Implausible>& found) {
  Scene free = scene;
  free.physics.conduction = free.physics.bulk_reaction = Switch::automatic;
  const auto forced_off = [&](Switch user, const Term& term, const char* key) {
    if (user == Switch::off && term.in) found.push_back(of_key(scene, key, "auto, because " + term.reason));
  };
  if (scene.physics.conduction != Switch::off && scene.physics.bulk_reaction != Switch::off) return;
  const Plan plan = make_plan(free);
  forced_off(scene.physics.conduction, plan.conduction, "physics.conduction");
  forced_off(scene.physics.bulk_reaction, plan.bulk_reaction, "physics.bulk_reaction");
}

/// Cracks that begin beyond the bound of their growth never grow.
void judge_crack_bound(const Scene& scene, std::vector<Implausible>& found) {
  const materials::ViscoScramParameters& strength = scene.charge().strength;
  if (strength.largest_crack_radius > strength.initial_crack_radius) return;
  found.push_back(of_key(scene, "charge.largest_crack_radius",
                         fmt::format("more than {}, because cracks of charge.crack_radius could not grow",
                                     length_text(strength.initial_crack_radius))));
}

using Number = std::optional<double>;

/// Of dry air, J/(kg K).
constexpr double gas_constant_of_air = 287.05;

double measured_peak(const Load& load) { return *std::ranges::max_element(load.curve_pressure); }

/// The largest pressure that the scene states, Pa, wherever in time it lies.
double stated_peak(const Load& load) {
  return load.curve_time.empty() || load.rescale_to_peak ? load.peak : measured_peak(load);
}

/// Only where it is another than the stated one, which is judged by itself.
Number simulated_peak(const Scene& scene) {
  constexpr double same = 0.99;
  const double peak = PressureHistory(scene.load).peak();
  if (peak >= same * stated_peak(scene.load)) return std::nullopt;
  return peak;
}

/// At a stated muzzle exit.
Number pressure_at_exit(const Scene& scene) {
  const auto exit = exit_time(scene.load);
  return exit ? Number(share_left(scene.load, *exit)) : std::nullopt;
}
Number calibres_to_exit(const Scene& scene, const RigidMotion& launch) {
  const auto exit = exit_time(scene.load);
  if (!exit) return std::nullopt;
  return calibres_of(scene, *exit == read_time(scene.load) ? launch : rigid_motion(scene, *exit));
}

/// Of an isotropic solid.
template <class Law>
double poisson_ratio(const Law& law) {
  const double bulk = law.bulk_modulus(), shear = law.shear_modulus();
  return (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
}

/// A quantity that only a scene with a charge has.
auto of_charge(double (*value)(const Scene&)) {
  return [value](const Scene& scene) { return has_charge(scene) ? Number(value(scene)) : std::nullopt; };
}

/// Temperature (K) at which self-heating without loss runs away within a second, with the leading term of the
/// induction time, c T^2/(Q Z E) exp(E/T); infinite without reaction. (Frank-Kamenetskii 1969.) Up to E/2
/// that time falls with T; with y = E/(2 T) > 1 it is y exp(-y) that is given.
double explosion_temperature(const Scene& scene) {
  const materials::KineticsParameters& kinetics = scene.charge().kinetics;
  const double activation = kinetics.activation_temperature;
  const double rate = kinetics.heat_of_reaction * kinetics.frequency / scene.charge().specific_heat;
  constexpr double delay = 1.0;  // s
  const double given = std::sqrt(0.25 * activation / (rate * delay));
  if (!(given < std::exp(-1.0))) return std::numeric_limits<double>::infinity();
  return -0.5 * activation / boost::math::lambert_wm1(-given);
}

/// `value`: of a scene, or of it and its motion.
template <class ValueOf>
DerivedQuantity quantity(std::string name, Dimension dimension, std::string sentence, Limits plausible,
                         std::string because, ValueOf value) {
  DerivedQuantity described{{.name = std::move(name),
                             .dimension = dimension,
                             .standing = Standing::derived,
                             .sentence = std::move(sentence),
                             .plausible = {.limits = plausible, .because = std::move(because)}},
                            {}};
  if constexpr (std::is_invocable_v<ValueOf, const Scene&>)
    described.value = [value](const Scene& scene, const RigidMotion&) { return Number(value(scene)); };
  else
    described.value = value;
  return described;
}

}  // namespace

std::string validity_warning(const Implausible& value) {
  return fmt::format("{} is not plausible ({})", value_text(value), value.range);
}

bool is_plausible(const KeyDescription& key, const Value& value) {
  const Plausible& plausible = key.plausible;
  if (const auto* number = std::get_if<double>(&value)) return is_plausible_number(plausible, *number);
  if (const auto* flag = std::get_if<bool>(&value))
    return is_plausible_word(plausible, *flag ? "true" : "false");
  if (const auto* word = std::get_if<std::string>(&value)) return is_plausible_word(plausible, *word);
  const auto& numbers = std::get<std::vector<double>>(value);
  if (key.kind == KeyKind::range) return is_plausible_number(plausible, numbers[1] - numbers[0]);
  return std::ranges::all_of(numbers, [&](double number) { return is_plausible_number(plausible, number); });
}

std::vector<Implausible> implausible_values(const Scene& scene) {
  return implausible_values(scene, rigid_motion(scene, read_time(scene.load)));
}

std::vector<Implausible> implausible_values(const Scene& scene, const RigidMotion& launch) {
  std::vector<Implausible> found;
  const auto judge = [&](const KeyDescription& key, const std::string& name, const Value& value) {
    if (!is_plausible(key, value))
      found.push_back(implausible(scene.accepted, key, name, value, plausible_text(key)));
  };
  for (const Key<Scene>& key : scene_keys())
    if (key.is_used(scene)) judge(key, key.name, key.get(scene));
  judge_crack_bound(scene, found);
  judge_switches(scene, found);
  visit_keys_of_tables(scene, [&](const auto& key, const std::string& name, const auto& value) {
    if (value) judge(key, name, *value);
  });
  for (const auto& [description, value_of] : derived_quantities())
    if (const auto value = value_of(scene, launch)) judge(description, description.name, Value(*value));
  return found;
}

std::vector<KeyDescription> acceptable_keys(const Scene& scene) {
  std::vector<KeyDescription> keys;
  const auto add = [&keys](KeyDescription key, const std::string& name) {
    key.name = name;
    keys.push_back(std::move(key));
  };
  for (const Key<Scene>& key : scene_keys()) add(key, key.name);
  visit_keys_of_tables(scene, [&](const auto& key, const std::string& name, const auto&) { add(key, name); });
  for (const DerivedQuantity& quantity : derived_quantities())
    add(quantity.description, quantity.description.name);
  for (const char* name : {foreign_shell, foreign_material, foreign_interfaces})
    add({.kind = KeyKind::text}, name);
  return keys;
}

const std::vector<DerivedQuantity>& derived_quantities() {
  static const Limits gun = between(10e6, 1e9);
  static const std::vector<DerivedQuantity> quantities{
      quantity("load.measured_peak", Dimension::pressure,
               "Largest pressure of a measured curve as it was measured, wherever in time it lies.", gun,
               "a mortar has 10 MPa, and no gun tube bears 1 GPa",
               [](const Scene& scene) {
                 return scene.load.curve_time.empty() ? Number() : measured_peak(scene.load);
               }),
      quantity("load.simulated_peak", Dimension::pressure,
               "Largest pressure until the end, where it is below the one that the scene states.", gun,
               "what lies outside of the simulated time does nothing", simulated_peak),
      quantity("load.rescaling", Dimension::number, "Factor on a measured curve by load.rescale_to_peak.",
               between(0.25, 4), "other charges of propellant than these make another shape of the curve",
               [](const Scene& scene) {
                 const bool is_scaled = !scene.load.curve_time.empty() && scene.load.rescale_to_peak;
                 return is_scaled ? Number(scene.load.peak / measured_peak(scene.load)) : std::nullopt;
               }),
      quantity("load.launch_speed", Dimension::speed,
               "Speed at the muzzle exit, or at the end, of the projectile as one rigid body.",
               between(300, 1.2e3),
               "howitzers and guns launch with 300 m/s to 1.2 km/s: low zones, mortars and tank guns are "
               "accepted with their number",
               [](const Scene&, const RigidMotion& launch) { return Number(launch.velocity); }),
      quantity("load.travel", Dimension::length,
               "Travel until the muzzle exit, or the end, of the projectile as one rigid body.",
               between(0.5, 15), "mortars have a tube of a metre, guns one of 2 to 11 m",
               [](const Scene&, const RigidMotion& launch) { return Number(launch.travel); }),
      quantity("load.exit_pressure", Dimension::number, "Pressure over its peak at a stated muzzle exit.",
               between(0, 0.25), "guns let the shot go at a tenth to a quarter of their peak pressure",
               pressure_at_exit),
      quantity("load.exit_calibres", Dimension::number,
               "Travel until a stated muzzle exit over the outer diameter.", between(10, 200),
               "mortars have barrels of 12 calibres or more, howitzers of 20, guns of 40 to 60",
               calibres_to_exit),
      quantity("steel.poisson_ratio", Dimension::number,
               "Poisson's ratio, from density, c0 and shear modulus.", between(0.24, 0.35),
               "steels have 0.27 to 0.30",
               [](const Scene& scene) {
                 return has_law<Steel>(scene) ? Number(poisson_ratio(scene.steel())) : std::nullopt;
               }),
      quantity("charge.poisson_ratio", Dimension::number,
               "Poisson's ratio before relaxation, from the JWL and the shear moduli.", between(0.1, 0.49),
               "explosives have 0.2 to 0.45",
               of_charge([](const Scene& scene) { return poisson_ratio(scene.charge()); })),
      quantity("charge.bulk_sound_speed", Dimension::speed, "Bulk sound speed, from the JWL and the density.",
               between(1.5e3, 5e3), "explosives have 2 to 3 km/s", of_charge([](const Scene& scene) {
                 return std::sqrt(scene.charge().bulk_modulus() / scene.charge().initial_density());
               })),
      quantity("charge.heat_capacity", Dimension::number,
               "Density times specific heat of the charge, in MJ/(m3 K).", between(1.2, 3.6),
               "explosives have 1.6 to 2.5, the published model 3.1", of_charge([](const Scene& scene) {
                 return 1e-6 * scene.charge().density * scene.charge().specific_heat;
               })),
      quantity("kinetics.explosion_temperature", Dimension::temperature,
               "Temperature at which self-heating runs away within a second, from Q, Z, E/R and specific "
               "heat.",
               between(400, 700), "explosives do so between 450 and 650 K", of_charge(explosion_temperature)),
      quantity("gap.heat_law", Dimension::number,
               "Specific heat over that of an ideal gas of air's molar mass and the given heat ratio.",
               between(0.9, 1.1), "air obeys the law within some percent", of_charge([](const Scene& scene) {
                 const materials::AirParameters& air = scene.surface.air;
                 return air.specific_heat * (air.heat_ratio - 1.0) / (air.heat_ratio * gas_constant_of_air);
               })),
      quantity("shell.length", Dimension::length, "Length of all bodies together.", between(0.02, 2.5),
               "the longest shells have 2 m",
               [](const Scene& scene) { return Number(extent_of(scene).x_end - extent_of(scene).x_begin); }),
      quantity("shell.radius", Dimension::length, "Largest radius of all bodies.", between(0.005, 0.25),
               "calibres go from machine cannons to 46 cm",
               [](const Scene& scene) { return Number(extent_of(scene).r_end); }),
  };
  return quantities;
}

}  // namespace launchsafe::scene
