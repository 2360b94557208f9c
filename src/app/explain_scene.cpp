#include "explain.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::app {
namespace {

/// What is launched, and by what, for people.
Json launch_told(const scene::Scene& scene) {
  const scene::Load& load = scene.load;
  const double peak = scene::PressureHistory(load).peak();
  std::vector<std::string> masses;
  for (const scene::Material& each : scene::used_materials(scene))
    masses.push_back(fmt::format("{} {:.6g}", each.name, scene::mass_of(scene, each.name)));
  const std::string measured =
      fmt::format("measured, {} points{}", load.curve_time.size(), load.rescale_to_peak ? ", rescaled" : "");
  return {{"mass", scene::total_mass(scene)},
          {"masses", masses},
          {"initial_temperature",
           scene::format_quantity(scene.initial_temperature, scene::Dimension::temperature)},
          {"shape", load.curve_time.empty() ? scene::word_of(load.shape) : measured},
          {"peak", scene::pressure_text(peak)},
          {"acts", scene::chamber_text(scene, peak)},
          {"exit", scene::exit_text(scene)},
          {"end", scene::end_text(scene)},
          {"measured", scene::smoothing_text(load)},
          {"acceleration", scene::rigid_acceleration(scene, peak)},
          {"setback", scene::has_charge(scene) ? scene::pressure_text(scene::setback_pressure(scene)) : ""}};
}

/// The bodies with their cells, and every line of the grid in SI.
Json grid_json(const scene::Scene& scene) {
  const scene::GridLines lines = scene::lines_at_rest(scene);
  Json bodies = Json::array();
  for (const scene::Body& body : scene.bodies) {
    const scene::CellRange cells = scene::cells_of(scene, body);
    const auto extent = [&body](const char* name) {
      const scene::Key<scene::Body>& key = *scene::find_key(scene::body_keys(), name);
      return scene::format_value(key, key.get(body));
    };
    bodies.push_back({{"name", body.name},
                      {"material", scene::material_text(scene, body)},
                      {"x", extent("x")},
                      {"r", extent("r")},
                      {"cells_in_x", cells.nx},
                      {"cells_in_r", cells.nr},
                      {"particles", scene::particles_of(scene, body).total()}});
  }
  return {{"x_lines_m", lines.x}, {"r_lines_m", lines.r}, {"bodies", bodies}};
}

Json physics_json(const scene::Plan& plan) {
  Json json;
  for (const scene::Term& term : plan.terms)
    json[std::string(term.member)] = {
        {"title", term.title}, {"in", term.in}, {"forced", term.forced}, {"reason", term.reason}};
  return json;
}

/// Before compression.
Json snapshots_json(const scene::Scene& scene) {
  if (!scene.output.asks_for_snapshots()) return nullptr;
  const run::SnapshotSize size = run::snapshot_size(scene);
  return {{"most_of_launch", size.of_launch},
          {"most_of_combustion", size.of_combustion},
          {"bytes_each", size.bytes_each},
          {"bytes", size.bytes()}};
}

}  // namespace

std::string uncovered_text(const scene::Load& load) {
  const std::vector<std::string> uncovered = run::uncovered_load(load);
  if (uncovered.empty()) return {};
  return fmt::format("\nNot covered: every verdict under this load is INDETERMINATE\n  {}\n",
                     fmt::join(uncovered, "\n  "));
}

std::string scene_text(const scene::Scene& scene, Json facts) {
  Json terms = Json::array();
  for (const Json& term : facts["physics"]) terms.push_back(term);
  facts["terms"] = terms;
  facts.update(launch_told(scene));
  facts.update({{"all_particles", scene::particle_count(scene)},
                {"off_grid", scene::charge_edges_off_grid(scene)},
                {"time_step", scene::time_text(facts["time_step_s"].get<double>())},
                {"sound", scene::longitudinal_speed(scene)},
                {"countable", facts["steps"] < scene::most_counted},
                {"uncovered", uncovered_text(scene.load)}});
  return told("explain.txt", facts);
}

Json load_json(const scene::Scene& scene) {
  const scene::Load& load = scene.load;
  const scene::PressureHistory history(load);
  const double end_time = scene::end_time(load);
  const scene::RigidMotion end = scene::rigid_motion(scene, end_time);
  Json exit = nullptr;
  if (const auto time = load.muzzle_exit) {
    const scene::RigidMotion motion = scene::rigid_motion(scene, *time);
    exit = {{"time_s", *time},
            {"velocity_m_per_s", motion.velocity},
            {"travel_m", motion.travel},
            {"share_of_peak", scene::share_left(load, *time)}};
  }
  return {{"muzzle_exit", exit},
          {"end_s", end_time},
          {"cut_short", scene::is_cut_short(load)},
          {"peak_pa", history.peak()},
          {"driving_band_m", scene::chamber_of(scene).band},
          {"driven_area_m2", scene::base_area(scene)},
          {"driving_force_n", scene::base_area(scene) * history.peak()},
          {"velocity_at_the_end_m_per_s", end.velocity},
          {"travel_at_the_end_m", end.travel},
          {"stated_peak_pa", history.stated_peak()},
          {"smoothing_s", load.smoothing},
          {"peak_lost_to_smoothing", scene::peak_lost_to_smoothing(load)},
          {"uncovered", run::uncovered_load(load)}};
}

Json scene_json(const scene::Scene& scene, double update_rate) {
  const scene::Plan plan = scene::make_plan(scene);
  Json interfaces = Json::array();
  for (const scene::InterfaceText& each : scene::describe_interfaces(scene))
    interfaces.push_back({{"body", each.body}, {"condition", each.condition}, {"assumes", each.assumes}});
  Json particles = Json::object();
  for (const scene::MaterialParticles& each : plan.by_material) particles[each.material] = each.particles;
  return {
      {"title", scene.title},
      {"load", load_json(scene)},
      {"interfaces", interfaces},
      {"physics", physics_json(plan)},
      {"particles", particles},
      {"cells", plan.cells},
      {"grid", grid_json(scene)},
      {"time_step_s", plan.time_step},
      {"steps", plan.steps},
      {"memory_bytes", plan.memory},
      {"snapshots", snapshots_json(scene)},
      {"updates_per_second", update_rate},
      {"predicted_time_s", plan.work / update_rate},
      {"predicted_time_of_a_coupled_run_s", plan.couples ? Json(plan.coupled_work / update_rate) : nullptr}};
}

}  // namespace launchsafe::app
