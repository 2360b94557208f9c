#include "explain.hpp"
#include "launchsafe/scene/plan.hpp"

#include <sstream>

namespace launchsafe::app {
namespace {

/// A body, or the whole grid, with its cells.
struct BodyRow {
  std::string name;
  scene::CellRange cells;
  std::int64_t particles;
  std::string material = {}, x = {}, r = {};
};

std::vector<BodyRow> bodies_of(const scene::Scene& scene) {
  std::vector<BodyRow> rows;
  for (const scene::Body& body : scene.bodies) {
    const auto extent = [&body](const char* name) {
      const scene::Key<scene::Body>& key = *scene::find_key(scene::body_keys(), name);
      return scene::format_value(key, key.get(body));
    };
    rows.push_back({body.name, scene::cells_of(scene, body), scene::particles_of(scene, body).total(),
                    scene::material_text(scene, body), extent("x"), extent("r")});
  }
  return rows;
}

report::Table body_table(const scene::Scene& scene) {
  const report::Quantities<BodyRow> quantities{
      {"body", "body", keys::text(), "The body.", &BodyRow::name},
      {"material", "material", keys::text(), "What it is made of.", &BodyRow::material},
      {"x", "x", keys::text(), "From where to where.", &BodyRow::x},
      {"r", "r", keys::text(), "Likewise.", &BodyRow::r},
      {"cells_in_x", "cells in x", keys::count(), "Along x.", &BodyRow::cells, &scene::CellRange::nx},
      {"in_r", "in r", keys::count(), "Along r.", &BodyRow::cells, &scene::CellRange::nr},
      {"cells", "cells", keys::count(), "Its cells.",
       [](const BodyRow& row) { return std::int64_t{row.cells.nx} * row.cells.nr; }},
      {"particles", "particles", keys::count(), "Its particles.", &BodyRow::particles}};
  std::vector<BodyRow> rows = bodies_of(scene);
  rows.push_back({"whole grid", scene::cells_of(scene), scene::particle_count(scene)});
  return report::table_of({}, quantities, rows);
}

/// Every line two columns further right.
std::string indented(const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) result += (line.empty() ? "" : "  ") + line + "\n";
  return result;
}

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

/// The same in SI, and every line of the grid.
Json grid_json(const scene::Scene& scene) {
  const scene::GridLines lines = scene::lines_at_rest(scene);
  Json bodies = Json::array();
  for (const BodyRow& body : bodies_of(scene))
    bodies.push_back({{"name", body.name},
                      {"cells_in_x", body.cells.nx},
                      {"cells_in_r", body.cells.nr},
                      {"particles", body.particles}});
  return {{"x_lines_m", lines.x}, {"r_lines_m", lines.r}, {"bodies", bodies}};
}

Json physics_json(const scene::Plan& plan) {
  Json json;
  for (const scene::NamedTerm& each : scene::plan_terms) {
    const scene::Term& term = plan.*each.term;
    json[std::string(each.member)] = {{"in", term.in},
                                      {"forced", term.forced},
                                      {"reason", term.reason},
                                      {"value", term.value},
                                      {"bound", term.bound}};
  }
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
  for (const scene::NamedTerm& each : scene::plan_terms) {
    facts["terms"].push_back(facts["physics"][std::string(each.member)]);
    facts["terms"].back()["title"] = each.title;
  }
  facts.update(launch_told(scene));
  facts.update({{"bodies", indented(report::to_text(body_table(scene)))},
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
  if (const auto time = scene::exit_time(load)) {
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
  return {{"title", scene.title},
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
          {"predicted_time_s", scene::predicted_time(plan, update_rate)},
          {"predicted_time_of_a_coupled_run_s",
           plan.coupling.in ? Json(plan.coupled_work / update_rate) : nullptr}};
}

}  // namespace launchsafe::app
