#include "launchsafe/study/record_domain.hpp"

#include "launchsafe/study/study_cases.hpp"

#include <set>

namespace launchsafe::study {
namespace {

using keys::ActsOn, keys::find_named, keys::Hotter, keys::Part;
using scene::Body, scene::Interface, scene::Material, scene::Scene, scene::Value;

/// m; much less than any tolerance of a drawing.
constexpr double same_place = 1e-6;

bool near(double a, double b) { return std::abs(a - b) <= same_place; }

bool share_place(const Body& a, const Body& b) {
  return near(a.x_begin, b.x_begin) && near(a.x_end, b.x_end) && near(a.r_begin, b.r_begin) &&
         near(a.r_end, b.r_end);
}

/// Whether bodies are of one law at the same places.
bool same_shell(const Scene& a, const Scene& b) {
  const auto same_body = [&](const Body& of_a, const Body& of_b) {
    return share_place(of_a, of_b) && scene::law_of(a, of_a).index() == scene::law_of(b, of_b).index();
  };
  return std::is_permutation(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(), same_body);
}

/// Eight digits by which people tell whether something is still the same.
std::string short_digest(const std::string& text) { return store::sha256(text).substr(0, 8); }

/// What another value of the shell is told by: its size, and a digest of its bodies.
std::string shell_value(const Scene& scene) {
  std::vector<std::string> bodies;
  for (const Body& body : scene.bodies) {
    const auto place = [](double length) { return std::llround(length / same_place); };
    bodies.push_back(fmt::format("{} {} {} {} {}", scene::law_of(scene, body).index(), place(body.x_begin),
                                 place(body.x_end), place(body.r_begin), place(body.r_end)));
  }
  std::ranges::sort(bodies);
  const scene::Extent all = scene::extent_of(scene);
  return fmt::format("{} bodies, {} long, {} in diameter, {}", bodies.size(),
                     scene::length_text(all.x_end - all.x_begin), scene::length_text(2.0 * all.r_end),
                     short_digest(fmt::format("{}", fmt::join(bodies, "\n"))));
}

std::string interfaces_value(const Scene& scene) {
  const std::vector<std::string> faces = of_each(scene::sliding_interfaces(scene), [](const Interface& each) {
    return fmt::format("{} sliding, friction {}", each.body,
                       scene::format_quantity(each.friction.value_or(0.0), scene::Dimension::number));
  });
  return faces.empty() ? "bonded for good" : fmt::format("{}", fmt::join(faces, "; "));
}

/// Whether the same faces slide in the same way. Those of the same shell are compared by their bodies'
/// places: another scene may give them other names. Bodies of another shell are compared by name.
bool same_interfaces(const Scene& scene, const Scene& recorded, bool shells_agree) {
  const auto ours = scene::sliding_interfaces(scene), theirs = scene::sliding_interfaces(recorded);
  const auto same = [&](const Interface& a, const Interface& b) {
    const Body *body = find_named(scene.bodies, a.body), *other = find_named(recorded.bodies, b.body);
    if (body == nullptr || other == nullptr) return false;
    const bool same_body = shells_agree ? share_place(*body, *other) : body->name == other->name;
    return same_body && a.condition == b.condition && a.friction == b.friction && a.against == b.against;
  };
  return ours.size() == theirs.size() && std::ranges::all_of(ours, [&](const Interface& a) {
           return std::ranges::any_of(theirs, [&](const Interface& b) { return same(a, b); });
         });
}

std::string points_value(const Scene& scene) {
  std::string text;
  for (const scene::ObservationPoint& each : scene.output.observation_points)
    text += fmt::format("{}{} at {} and {}", text.empty() ? "" : "; ", each.name, scene::length_text(each.x),
                        scene::length_text(each.r));
  return text;
}

/// Told before any text is made; other points may still read the same.
bool same_points(const Scene& scene, const Scene& recorded) {
  const auto same = [](const scene::ObservationPoint& a, const scene::ObservationPoint& b) {
    return a.name == b.name && a.x == b.x && a.r == b.r;
  };
  return std::ranges::equal(scene.output.observation_points, recorded.output.observation_points, same);
}

class Comparison {
 public:
  Comparison(const Scene& scene, const Scene& recorded)
      : scene_(scene), recorded_(recorded), shells_agree_(same_shell(scene, recorded)) {
    if (!shells_agree_) add(scene::foreign_shell, shell_value, {});
    compare_keys();
    compare_materials();
    if (!same_interfaces(scene, recorded, shells_agree_))
      add(scene::foreign_interfaces, interfaces_value, scene::interface_keys().front().role());
    if (!same_points(scene, recorded) && points_value(scene) != points_value(recorded))
      add("observation_point", points_value, scene::observation_point_keys().front().role());
  }
  std::vector<Difference> found;

 private:
  /// What is no key: a property of the whole scene.
  void add(const char* name, std::string (*value_of)(const Scene&), const keys::Role& role) {
    found.push_back({{.name = name, .kind = scene::KeyKind::text, .stated_role = role},
                     Value(value_of(scene_)),
                     Value(value_of(recorded_))});
  }

  /// Of a measured curve the peak is that of its points.
  void compare_keys() {
    static const std::set<std::string> of_laws = [] {
      std::set<std::string> names;
      materials::for_each_law([&]<class Law>(const Law&) {
        for (const auto& key : Law::parameters()) names.insert(key.name);
      });
      return names;
    }();
    const bool measured = !scene_.load.curve_time.empty() || !recorded_.load.curve_time.empty();
    const scene::Key<Scene>& peak = *scene::find_key(scene::scene_keys(), "load.peak");
    const auto compare = [&](const scene::KeyDescription& key, const Value& value, const Value& wanted) {
      if (!same_value(value, wanted)) found.push_back({key, value, wanted, of_laws.contains(key.name)});
    };
    for (const auto& key : scene::scene_keys()) {
      if (!measured || &key != &peak) compare(key, key.get(scene_), key.get(recorded_));
      if (is_stated_by_one(key, scene_, recorded_))
        found.push_back({key, key.get(scene_), key.get(recorded_)});
    }
    materials::for_each_law([&]<class Law>(const Law&) { compare_forms<Law>(); });
    if (measured)
      compare(peak, scene::PressureHistory(scene_.load).stated_peak(),
              scene::PressureHistory(recorded_.load).stated_peak());
  }

  /// What is not said may mean something else than the value that it reads as.
  template <class Owner>
  static bool is_stated_by_one(const scene::Key<Owner>& key, const Owner& ours, const Owner& theirs) {
    return key.is_written && key.is_written(ours) != key.is_written(theirs) &&
           same_value(key.get(ours), key.get(theirs));
  }

  /// A key that only one of them has is of another form of the law, also where it is as usual there.
  template <class Law>
  void compare_forms() {
    static const std::vector<scene::Key<Law>> keys = Law::parameters();
    const Law &ours = scene_.parameters<Law>(), &theirs = recorded_.parameters<Law>();
    for (const scene::Key<Law>& key : keys)
      if (is_stated_by_one(key, ours, theirs)) found.push_back({key, key.get(ours), key.get(theirs), true});
  }

  /// Whether the keys of the scenes speak of both.
  bool compared_by_keys(const Material& ours, const Material& theirs) const {
    return std::visit(
        [&]<class Law>(const Law&) {
          return std::holds_alternative<Law>(theirs.law) && ours.name == scene_.material<Law>().name &&
                 theirs.name == recorded_.material<Law>().name;
        },
        ours.law);
  }

  /// What of a material is not as in another one. No rule speaks of it, so that it changes everything.
  std::vector<Difference> between(const Material& ours, const Material& theirs) const {
    std::vector<Difference> all;
    if (compared_by_keys(ours, theirs)) return all;
    const auto add = [&](scene::KeyDescription key, const std::string& name, Value value, Value wanted) {
      key.name = fmt::format("material.{}.{}", ours.name, name);
      key.stated_role = keys::Role{};
      all.push_back({std::move(key), std::move(value), std::move(wanted), true});
    };
    std::visit(
        [&]<class Law>(const Law& law) {
          const Law* other = std::get_if<Law>(&theirs.law);
          if (other == nullptr)
            return add({.kind = scene::KeyKind::text}, "law", std::string(Law::name),
                       std::string("another law"));
          for (const auto& key : Law::parameters())
            if (key.role().part != Part::free && !same_value(key.get(law), key.get(*other)))
              add(key, scene::key_in_material(Law::name, key.name), key.get(law), key.get(*other));
        },
        ours.law);
    return all;
  }

  /// Each with the one at its place, or the one of another shell that is the most like it.
  void compare_materials() {
    std::set<std::string> compared;
    for (const Body& body : scene_.bodies) {
      const Material& material = *scene::find_material(scene_, body.material);
      std::vector<std::vector<Difference>> candidates;
      for (const Body& there : recorded_.bodies)
        if (!shells_agree_ || share_place(body, there))
          candidates.push_back(between(material, *scene::find_material(recorded_, there.material)));
      const auto fewest = std::ranges::min_element(candidates, {}, &std::vector<Difference>::size);
      if (fewest == candidates.end() || fewest->empty() || !compared.insert(material.name).second) continue;
      std::ranges::move(*fewest, std::back_inserter(found));
    }
  }

  const Scene &scene_, &recorded_;
  bool shells_agree_;
};

/// Whether a constant has a value that makes a hotter skin or an earlier ignition than the recorded one.
bool is_hotter(const Difference& difference) {
  const Hotter hotter = difference.key.role().hotter;
  if (hotter == Hotter::nowhere) return false;
  return (std::get<double>(difference.value) > std::get<double>(difference.recorded)) ==
         (hotter == Hotter::above);
}

/// Several numbers of materials are one property, with a digest of their values; the keys of these. When the
/// explosive ignites is a constant of the calibration, and friction of cracks is part of the model.
std::vector<std::string> summarise_materials(std::vector<Difference>& foreign) {
  const auto of_material = [](const Difference& each) {
    return each.of_material && each.key.role().part == Part::constant;
  };
  std::string values;
  std::vector<std::string> names;
  for (const Difference& each : foreign) {
    if (!of_material(each)) continue;
    names.push_back(each.key.name);
    values += fmt::format("{} = {}\n", each.key.name, scene::format_value(each.key, each.value));
  }
  if (names.size() < 2) return {};
  std::erase_if(foreign, of_material);
  const auto place = std::ranges::find(foreign, scene::foreign_interfaces,
                                       [](const Difference& each) { return each.key.name; });
  foreign.insert(place, {{.name = scene::foreign_material, .kind = scene::KeyKind::text},
                         fmt::format("{}, {}", scene::first_of(names, 3), short_digest(values)),
                         std::string("other numbers")});
  return names;
}

std::string name_for_people(const std::string& key) {
  if (key == "load.peak") return "peak pressure";
  if (key == "charge.crack_radius") return "crack radius";
  if (key == "charge.flaw_size") return "flaw size";
  if (key == "initial_temperature") return "initial temperature";
  return key;
}

/// What a record does with a difference: nothing, as it does not matter to it or as the record judges it by
/// its own numbers; it carries its errors over; it says nothing. Over a hotter value alone errors are
/// carried.
enum class Effect { none, carried, foreign, carried_if_hotter };
Effect effect_on(RecordKind record, const Difference& difference) {
  using enum Effect;
  // Of each part to the kinds of record, in their orders.
  constexpr std::array<std::array<Effect, 2>, 8> effects{{
      {carried_if_hotter, foreign},  // constant
      {foreign, foreign},            // model
      {carried_if_hotter, none},     // calibrated
      {carried, none},               // range
      {carried, none},               // load_shape
      {carried, none},               // setting
      {none, none},                  // minor_setting
      {none, none},                  // free
  }};
  const keys::Role role = difference.key.role();
  // What heats the skin alone is among the numbers of the recorded launch; the chemistry comes after it.
  if (role.part == Part::constant && record == RecordKind::accuracy &&
      (!keys::reaches_mechanics(role.acts_on) || role.acts_on == ActsOn::chemistry))
    return none;
  const Effect effect = effects.at(static_cast<std::size_t>(role.part)).at(static_cast<std::size_t>(record));
  if (effect != carried_if_hotter) return effect;
  return is_hotter(difference) ? carried : foreign;
}

}  // namespace

std::vector<Difference> differences(const Scene& scene, const Scene& recorded) {
  return Comparison(scene, recorded).found;
}

std::vector<std::string> RecordDistance::names() const {
  std::vector<std::string> names = of_each(foreign, &scene::Implausible::key);
  names.insert(names.end(), carried.begin(), carried.end());
  return names;
}

RecordDistance distance_to_record(RecordKind record, const Scene& scene, const Scene& recorded) {
  RecordDistance distance;
  std::vector<Difference> foreign;
  for (Difference& each : differences(scene, recorded)) {
    const Effect effect = effect_on(record, each);
    const Part part = each.key.role().part;
    if (effect == Effect::foreign)
      foreign.push_back(std::move(each));
    else if (effect == Effect::carried && part == Part::load_shape)
      distance.other_load_shape = true;
    else if (effect == Effect::carried && part == Part::setting)
      distance.other_numerics = true;
    else if (effect == Effect::carried)
      distance.carried.push_back(name_for_people(each.key.name));
  }
  if (distance.other_load_shape) distance.carried.emplace_back("load shape");
  if (distance.other_numerics) distance.carried.emplace_back("numerics");
  const std::vector<std::string> summarised = summarise_materials(foreign);
  for (const Difference& each : foreign) {
    distance.foreign.push_back(
        scene::implausible(scene.accepted, each.key, each.key.name, each.value,
                           "calibrated with " + scene::format_value(each.key, each.recorded)));
    if (each.key.name == scene::foreign_material) distance.foreign.back().stands_for = summarised;
  }
  return distance;
}

}  // namespace launchsafe::study
