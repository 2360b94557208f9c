#include "launchsafe/scene/plausibility.hpp"

#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/named_material.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::scene {
namespace {

bool is_plausible_number(const Plausible& plausible, double number) {
  return (plausible.or_zero && number == 0.0) || plausible.limits.contain(number);
}

bool is_plausible_word(const Plausible& plausible, const std::string& word) {
  return plausible.words.empty() ||
         std::find(plausible.words.begin(), plausible.words.end(), word) != plausible.words.end();
}

class Judge {
 public:
  explicit Judge(const Scene& scene) : scene_(scene) {}

  void key(const KeyDescription& key, const std::string& name, const Value& value) {
    if (!is_plausible(key, value)) add(key, name, value, plausible_text(key));
  }
  void add(const KeyDescription& key, const std::string& name, const Value& value, std::string range) {
    found_.push_back(implausible(scene_.accepted, key, name, value, std::move(range)));
  }
  /// The value of a key of the scene.
  void add(const std::string& name, std::string range) {
    const Key<Scene>& key = *find_key(scene_keys(), name);
    add(key, name, key.get(scene_), std::move(range));
  }
  std::vector<Implausible> take() { return std::move(found_); }

 private:
  const Scene& scene_;
  std::vector<Implausible> found_;
};

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
void judge_switches(const Scene& scene, Judge& judge) {
  Scene free = scene;
  free.physics.conduction = free.physics.bulk_reaction = Switch::automatic;
  const auto forced_off = [&judge](Switch user, const Term& term, const char* key) {
    if (user == Switch::off && term.in) judge.add(key, "auto, because " + term.reason);
  };
  if (scene.physics.conduction != Switch::off && scene.physics.bulk_reaction != Switch::off) return;
  const Plan plan = make_plan(free);
  forced_off(scene.physics.conduction, plan.conduction, "physics.conduction");
  forced_off(scene.physics.bulk_reaction, plan.bulk_reaction, "physics.bulk_reaction");
}

/// Cracks that begin beyond the bound of their growth never grow.
void judge_crack_bound(const Scene& scene, Judge& judge) {
  const materials::ViscoScramParameters& strength = scene.charge().strength;
  if (strength.largest_crack_radius > strength.initial_crack_radius) return;
  judge.add("charge.largest_crack_radius",
            fmt::format("more than {}, because cracks of charge.crack_radius could not grow",
                        length_text(strength.initial_crack_radius)));
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
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](double number) { return is_plausible_number(plausible, number); });
}

std::vector<Implausible> implausible_values(const Scene& scene) {
  return implausible_values(scene, rigid_motion(scene, read_time(scene.load)));
}

std::vector<Implausible> implausible_values(const Scene& scene, const RigidMotion& launch) {
  Judge judge(scene);
  for (const Key<Scene>& key : scene_keys()) {
    if (key.is_used(scene)) judge.key(key, key.name, key.get(scene));
  }
  judge_crack_bound(scene, judge);
  judge_switches(scene, judge);
  visit_keys_of_tables(scene, [&](const auto& key, const std::string& name, const auto& value) {
    if (value) judge.key(key, name, *value);
  });
  for (const DerivedQuantity& quantity : derived_quantities()) {
    if (const auto value = quantity.value(scene, launch))
      judge.key(quantity.description, quantity.description.name, Value(*value));
  }
  return judge.take();
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
  add({.kind = KeyKind::number, .dimension = Dimension::pressure}, pressure_of_models);
  return keys;
}

}  // namespace launchsafe::scene
