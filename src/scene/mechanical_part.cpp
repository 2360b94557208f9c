
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <cmath>

namespace launchsafe::scene {
namespace {

/// Which inputs do not reach the mechanics of a launch.
class Unfelt {
 public:
  Unfelt(const Plan& plan, bool stores_temperatures)
      : conducts_(plan.conduction.in),
        reacts_(plan.bulk_reaction.in),
        temperatures_matter_(conducts_ || reacts_ || stores_temperatures) {}

  /// Sets them, and what does nothing anyway, to their defaults, where they have one.
  template <class Owner>
  void drop(const std::vector<Key<Owner>>& keys, Owner& owner) const {
    for (const Key<Owner>& key : keys) {
      const bool felt = key.is_used(owner) && !contains(key.role().acts_on);
      if (!felt && key.standing != Standing::input && key.get(owner) != key.default_value())
        key.set(owner, key.default_value());
    }
  }

 private:
  bool contains(ActsOn acts_on) const {
    if (acts_on == ActsOn::heat) return !temperatures_matter_;
    if (acts_on == ActsOn::conduction) return !conducts_;
    if (acts_on == ActsOn::chemistry) return !reacts_;
    return !keys::reaches_mechanics(acts_on);
  }
  bool conducts_, reacts_, temperatures_matter_;
};

/// What no body is made of stands at its default.
void settle_materials(Scene& part, const Unfelt& unfelt) {
  for (Material& material : part.materials) {
    const bool used = is_used(part, material.name);
    std::visit(
        [&]<class Law>(Law& law) {
          static const std::vector<Key<Law>> keys = Law::parameters();
          if (!used) law = Law{};
          unfelt.drop(keys, law);
        },
        material.law);
  }
}

bool is_negative_zero(double number) { return number == 0.0 && std::signbit(number); }

void clear_sign(double& number) {
  if (is_negative_zero(number)) number = 0.0;
}

template <class Owner>
void clear_signs_of_zeros(const std::vector<Key<Owner>>& keys, Owner& owner) {
  for (const Key<Owner>& key : keys) {
    Value value = key.get(owner);
    if (std::holds_alternative<std::string>(value) || std::holds_alternative<bool>(value)) continue;
    if (auto* number = std::get_if<double>(&value)) {
      if (is_negative_zero(*number)) key.set(owner, Value(0.0));
    } else {
      auto& numbers = std::get<std::vector<double>>(value);
      if (std::ranges::none_of(numbers, is_negative_zero)) continue;
      for (double& each : numbers) clear_sign(each);
      key.set(owner, value);
    }
  }
}

void clear_signs_of_zeros(Scene& scene) {
  clear_signs_of_zeros(scene_keys(), scene);
  for (Body& body : scene.bodies) clear_signs_of_zeros(body_keys(), body);
  for (Interface& faces : scene.interfaces)
    if (faces.friction) clear_sign(*faces.friction);
  for (ObservationPoint& point : scene.output.observation_points)
    clear_signs_of_zeros(observation_point_keys(), point);
}

}  // namespace

Scene mechanical_part(const Scene& scene) {
  const Plan plan = make_plan(scene);
  Scene part = scene;
  // Of a gap, and of what follows its ignition, the mechanics knows nothing.
  std::erase_if(part.output.snapshot_times, [&](double time) {
    return scene.coupling == Coupling::two_way && time > end_time(scene.load) * (1.0 + 1e-12);
  });
  std::erase_if(part.output.snapshot_events,
                [](Event event) { return event == Event::ignition || event == Event::burnt; });
  clear_remarks(part);
  part.accepted.clear();
  part.interfaces = sliding_interfaces(scene);
  // The mechanics knows the time of the exit, however it was stated.
  part.load.muzzle_exit = exit_time(scene.load);
  part.load.muzzle_travel.reset();
  part.surface.opens_by_cooling.reset();
  const Unfelt unfelt(plan, part.output.asks_for_snapshots());
  unfelt.drop(scene_keys(), part);
  settle_materials(part, unfelt);
  // The plan's decisions instead of what they rest on.
  part.physics = {.conduction = plan.conduction.in ? Switch::on : Switch::off,
                  .bulk_reaction = plan.bulk_reaction.in ? Switch::on : Switch::off};
  std::ranges::sort(part.output.snapshot_times);
  clear_signs_of_zeros(part);
  return part;
}

}  // namespace launchsafe::scene
