#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <span>

namespace launchsafe::scene {
namespace {

/// Which inputs reach the mechanics of a launch.
struct Felt {
  bool conducts = false, reacts = false, stores_temperatures = false;

  bool contains(ActsOn acts_on) const {
    if (acts_on == ActsOn::heat) return conducts || reacts || stores_temperatures;
    if (acts_on == ActsOn::conduction) return conducts;
    if (acts_on == ActsOn::chemistry) return reacts;
    return keys::reaches_mechanics(acts_on);
  }

  /// Sets all others, and what does nothing anyway, to their defaults, where they have one.
  template <class Owner>
  void keep_alone(const std::vector<Key<Owner>>& keys, Owner& owner) const {
    for (const Key<Owner>& key : keys)
      if (!(key.is_used(owner) && contains(key.role().acts_on)) && key.standing != Standing::input &&
          key.get(owner) != key.default_value())
        key.set(owner, key.default_value());
  }
};

/// What no body is made of stands at its default.
void settle_materials(Scene& part, const Felt& felt) {
  for (Material& material : part.materials) {
    const bool used = is_used(part, material.name);
    std::visit(
        [&]<class Law>(Law& law) {
          static const std::vector<Key<Law>> keys = Law::parameters();
          if (!used) law = Law{};
          felt.keep_alone(keys, law);
        },
        material.law);
  }
}

bool is_negative_zero(double number) { return number == 0.0 && std::signbit(number); }

template <class Owner>
void clear_signs_of_zeros(const std::vector<Key<Owner>>& keys, Owner& owner) {
  for (const Key<Owner>& key : keys) {
    Value value = key.get(owner);
    double* number = std::get_if<double>(&value);
    auto* list = std::get_if<std::vector<double>>(&value);
    const std::span<double> numbers = number ? std::span(number, 1)
                                      : list ? std::span(*list)
                                             : std::span(number, 0);
    if (std::ranges::none_of(numbers, is_negative_zero)) continue;
    std::ranges::replace_if(numbers, is_negative_zero, 0.0);
    key.set(owner, value);
  }
}

void clear_signs_of_zeros(Scene& scene) {
  clear_signs_of_zeros(scene_keys(), scene);
  for (Body& body : scene.bodies) clear_signs_of_zeros(body_keys(), body);
  for (Interface& faces : scene.interfaces) clear_signs_of_zeros(interface_keys(), faces);
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
  const Felt felt{plan.conduction.in, plan.bulk_reaction.in, part.output.asks_for_snapshots()};
  felt.keep_alone(scene_keys(), part);
  settle_materials(part, felt);
  // The plan's decisions instead of what they rest on.
  part.physics = {.conduction = plan.conduction.in ? Switch::on : Switch::off,
                  .bulk_reaction = plan.bulk_reaction.in ? Switch::on : Switch::off};
  std::ranges::sort(part.output.snapshot_times);
  clear_signs_of_zeros(part);
  return part;
}

}  // namespace launchsafe::scene
