#include "launchsafe/scene/mechanical_part.hpp"

#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::scene {
namespace {

/// Without the numbers of the load that its shape does not have, or that a measured curve takes the place of.
Load without_unused(Load load) {
  load.curve_file.clear();
  const Load usual;
  // The mechanics knows the time of the exit, however it was stated.
  load.muzzle_exit = exit_time(load);
  load.muzzle_travel.reset();
  load.muzzle_exit_spread = usual.muzzle_exit_spread;
  if (!load.muzzle_exit) load.exit_decay = usual.exit_decay;
  const bool measured = !load.curve_time.empty(), bell = load.shape == LoadShape::bell;
  if (measured || bell) load.exponent = usual.exponent;
  if (measured || !bell) {
    load.width = usual.width;
    load.steepness = usual.steepness;
  }
  if (!measured) return load;
  load.shape = usual.shape;
  load.base = usual.base;
  load.peak_time = usual.peak_time;
  if (!load.rescale_to_peak) load.peak = usual.peak;
  return load;
}

/// The bottom pressure of a trace never falls below the air's initial pressure. The closure heats the bulk of
/// the charge.
Surface surface_part(const Surface& surface, bool temperatures_matter) {
  Surface part;
  part.air.initial_pressure = surface.air.initial_pressure;
  part.station_width = surface.station_width;
  part.station_depth = surface.station_depth;
  if (temperatures_matter) part.friction = surface.friction;
  return part;
}

Switch decided(const Term& term) { return term.in ? Switch::on : Switch::off; }

/// The plan's decisions instead of what they rest on.
void settle_physics(const Plan& plan, Physics& physics) {
  const Physics usual;
  physics.conduction = decided(plan.conduction);
  physics.bulk_reaction = decided(plan.bulk_reaction);
  physics.conduction_bound = usual.conduction_bound;
  physics.reaction_bound = usual.reaction_bound;
}

/// What of a law acts through heat alone, at its default where that heat is left out.
template <class Law>
void drop_heat(Law& law, bool conducts, bool temperatures_matter) {
  static const std::vector<Key<Law>> keys = Law::parameters();
  for (const Key<Law>& key : keys) {
    const bool unused =
        (key.dimension == Dimension::conductivity && !conducts) ||
        (key.dimension == Dimension::specific_heat && !Law::heats_itself && !temperatures_matter);
    if (unused) key.set(law, key.default_value());
  }
}

/// What no body is made of stands at its default.
void settle_materials(Scene& part, bool conducts, bool temperatures_matter) {
  for (Material& material : part.materials) {
    const bool used = std::any_of(part.bodies.begin(), part.bodies.end(),
                                  [&](const Body& body) { return body.material == material.name; });
    std::visit(
        [&]<class Law>(Law& law) {
          if (!used) law = Law{};
          drop_heat(law, conducts, temperatures_matter);
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
      if (std::none_of(numbers.begin(), numbers.end(), is_negative_zero)) continue;
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
  // Temperatures of the charge act on the mechanics only through conduction into the steel, and are stored in
  // snapshots.
  const bool temperatures_matter =
      plan.conduction.in || plan.bulk_reaction.in || part.output.asks_for_snapshots();
  clear_remarks(part);
  part.accepted.clear();
  part.coupling = Coupling::one_way;  // until ignition nothing acts back
  part.combustion = {};
  part.interfaces = sliding_interfaces(scene);
  part.load = without_unused(std::move(part.load));
  part.surface = surface_part(scene.surface, temperatures_matter);
  settle_materials(part, plan.conduction.in, temperatures_matter);
  if (!plan.bulk_reaction.in) part.charge().kinetics = Charge{}.kinetics;
  settle_physics(plan, part.physics);
  std::sort(part.output.snapshot_times.begin(), part.output.snapshot_times.end());
  clear_signs_of_zeros(part);
  return part;
}

}  // namespace launchsafe::scene
