#include "explain_scene.hpp"

#include "launchsafe/run/cost.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/scheduler.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

nlohmann::ordered_json term_json(const scene::Term& term) {
  return {{"in", term.in},
          {"forced", term.forced},
          {"reason", term.reason},
          {"value", term.value},
          {"bound", term.bound}};
}

nlohmann::ordered_json physics_json(const scene::Plan& plan) {
  return {{"surface", term_json(plan.surface)},
          {"air", term_json(plan.air)},
          {"friction_heat", term_json(plan.friction_heat)},
          {"cracks", term_json(plan.cracks)},
          {"crack_growth", term_json(plan.crack_growth)},
          {"crack_friction", term_json(plan.crack_friction)},
          {"conduction", term_json(plan.conduction)},
          {"bulk_reaction", term_json(plan.bulk_reaction)},
          {"inertial_scaling", term_json(plan.inertial_scaling)},
          {"snapshots", term_json(plan.snapshots)}};
}

nlohmann::ordered_json particles_json(const scene::Plan& plan) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const scene::MaterialParticles& each : plan.by_material) json[each.material] = each.particles;
  return json;
}

nlohmann::ordered_json interfaces_json(const scene::Scene& scene) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scene::InterfaceText& each : scene::describe_interfaces(scene))
    list.push_back({{"body", each.body}, {"condition", each.condition}, {"assumes", each.assumes}});
  return list;
}

run::Reach reach_here() { return {.memory = study::available_memory(), .keeps_skins = true}; }

}  // namespace

std::string scene_text(const scene::Scene& scene, double update_rate) {
  std::string text = scene::to_text(scene::make_plan(scene), scene, update_rate) + "\n" + grid_text(scene);
  if (const auto refusal = run::out_of_reach(scene, reach_here()))
    text += fmt::format("\nRefused by launchsafe run\n  {}\n", refusal->message());
  return text;
}

nlohmann::ordered_json load_json(const scene::Load& load) {
  const scene::PressureHistory history(load);
  return {{"peak_pa", history.peak()},
          {"stated_peak_pa", history.stated_peak()},
          {"smoothing_s", load.smoothing},
          {"peak_lost_to_smoothing", scene::peak_lost_to_smoothing(load)},
          {"roughness", scene::load_roughness(load)}};
}

nlohmann::ordered_json scene_json(const scene::Scene& scene, double update_rate) {
  const scene::Plan plan = scene::make_plan(scene);
  const auto refusal = run::out_of_reach(scene, reach_here());
  return {{"title", scene.title},
          {"load", load_json(scene.load)},
          {"interfaces", interfaces_json(scene)},
          {"physics", physics_json(plan)},
          {"particles", particles_json(plan)},
          {"cells", plan.cells},
          {"grid", grid_json(scene)},
          {"time_step_s", plan.time_step},
          {"steps", plan.steps},
          {"memory_bytes", plan.memory},
          {"updates_per_second", update_rate},
          {"predicted_time_s",
           update_rate > 0 ? nlohmann::ordered_json(scene::predicted_time(plan, update_rate)) : nullptr},
          {"refused", refusal ? nlohmann::ordered_json(refusal->message()) : nlohmann::ordered_json()}};
}

}  // namespace launchsafe::app
