#include "explain_scene.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/scene/grid_intervals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace launchsafe::app {
namespace {

using report::Notation, report::text_column;

report::Column lengths(const char* name, int digits) {
  return {.name = name, .unit = "mm", .decimals = digits, .notation = Notation::significant};
}

report::Column counts(const char* name) { return {.name = name, .unit = {}}; }

/// The first of them where they are many.
std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t most_named = 4;
  const std::size_t named = std::min(names.size(), most_named);
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(named), ", "));
  if (named < names.size()) text += fmt::format(" and {} more", names.size() - named);
  return text;
}

report::Table interval_table(const scene::Scene& scene) {
  report::Table table{.title = {},
                      .columns = {text_column("along"), lengths("from", 7), lengths("to", 7), counts("cells"),
                                  lengths("smallest", 4), lengths("largest", 4),
                                  text_column("edge before, of"), text_column("edge behind, of")},
                      .rows = {}};
  const scene::GridIntervals intervals = scene::grid_intervals(scene);
  const auto add = [&table](const char* direction, const std::vector<scene::GridInterval>& all) {
    for (const scene::GridInterval& each : all)
      table.rows.push_back({direction, 1e3 * each.from, 1e3 * each.to, std::int64_t{each.cells},
                            1e3 * each.shortest, 1e3 * each.longest, list_of(each.edge_before),
                            list_of(each.edge_behind)});
  };
  add("x", intervals.x);
  add("r", intervals.r);
  if (scene.numerics.formulation == scene::Formulation::updated_lagrangian)
    table.notes = {"The grid is even and need not run through edges of bodies."};
  return table;
}

report::Table body_table(const scene::Scene& scene) {
  report::Table table{.title = {},
                      .columns = {text_column("body"), counts("cells in x"), counts("in r"), counts("cells"),
                                  counts("particles")},
                      .rows = {}};
  const auto add = [&table](const std::string& name, const scene::CellRange& cells, std::int64_t particles) {
    table.rows.push_back(
        {name, std::int64_t{cells.nx}, std::int64_t{cells.nr}, std::int64_t{cells.nx} * cells.nr, particles});
  };
  for (const scene::Body& body : scene.bodies)
    add(body.name, scene::cells_of(scene, body), scene::particles_of(scene, body).total());
  add("whole grid", scene::cells_of(scene), scene::particle_count(scene));
  return table;
}

/// Every line two columns further right.
std::string indented(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    result += (end - begin > 1 ? "  " : "") + text.substr(begin, end - begin);
    begin = end;
  }
  return result;
}

nlohmann::ordered_json intervals_json(const std::vector<scene::GridInterval>& intervals) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const scene::GridInterval& each : intervals)
    json.push_back({{"from_m", each.from},
                    {"to_m", each.to},
                    {"cells", each.cells},
                    {"smallest_cell_m", each.shortest},
                    {"largest_cell_m", each.longest},
                    {"edge_before_of", each.edge_before},
                    {"edge_behind_of", each.edge_behind}});
  return json;
}

}  // namespace

std::string grid_text(const scene::Scene& scene) {
  return "Grid\n" +
         indented(report::to_text(interval_table(scene)) + "\n" + report::to_text(body_table(scene)));
}

nlohmann::ordered_json grid_json(const scene::Scene& scene) {
  const scene::GridLines lines = scene::lines_at_rest(scene);
  const scene::GridIntervals intervals = scene::grid_intervals(scene);
  nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
  for (const scene::Body& body : scene.bodies) {
    const scene::CellRange cells = scene::cells_of(scene, body);
    bodies.push_back({{"name", body.name},
                      {"cells_in_x", cells.nx},
                      {"cells_in_r", cells.nr},
                      {"particles", scene::particles_of(scene, body).total()}});
  }
  return {{"x_lines_m", lines.x},
          {"r_lines_m", lines.r},
          {"x_intervals", intervals_json(intervals.x)},
          {"r_intervals", intervals_json(intervals.r)},
          {"bodies", bodies}};
}

}  // namespace launchsafe::app
