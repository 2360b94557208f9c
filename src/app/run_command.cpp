// launchsafe run: one case.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::app {
namespace {

struct RunArguments {
  path scene;
  std::optional<path> output;  ///< folder of the case file; none: nothing is written
  std::string command;         ///< the whole command, to be repeated in a shell
};

/// One gap of a run, with the names of places.
struct GapRow {
  const run::GapResult* gap;
  std::optional<study::Peak> at_stations = {}, at_points = {};  ///< nothing where there are none
  std::optional<study::NamedIgnition> ignition = {};
};

std::vector<GapRow> rows_of(const run::CaseResult& result) {
  const trace::BottomTrace& trace = result.mechanics.trace;
  std::vector<GapRow> rows;
  for (const run::GapResult& gap : result.gaps) {
    GapRow& row = rows.emplace_back(GapRow{&gap});
    if (!trace.stations.empty()) row.at_stations = study::peak_of(gap.at_stations, trace);
    if (std::ranges::any_of(trace.stations, &trace::Station::observation))
      row.at_points = study::peak_of(gap.at_points, trace);
    row.ignition = study::named(gap.skin.ignition, trace);
  }
  return rows;
}

/// What temperature, place and instant are called.
report::Quantities<study::Peak> peak_quantities(const char* temperature = "T max", const char* place = "at",
                                                const char* time = "time") {
  using namespace report::quantity;
  return {{headed(temperature, temperature_max), &study::Peak::temperature},
          {headed(place, temperature_max_place), &study::Peak::point},
          {headed(time, temperature_max_time), &study::Peak::time}};
}

report::Quantities<GapRow> gap_quantities(bool points) {
  return keys::joined<GapRow>(
      {{{report::quantity::gap, &GapRow::gap, &run::GapResult::gap}},
       report::of_part<GapRow>(peak_quantities(), &GapRow::at_stations),
       points
           ? report::of_part<GapRow>(peak_quantities("T max at points", "where", "when"), &GapRow::at_points)
           : report::Quantities<GapRow>{},
       {{report::Column{"ignition", "ignition", keys::text(), "Cause, instant and station of ignition."},
         [](const GapRow& row) -> std::string {
           if (!row.ignition) return "none";
           const bool by_trigger = row.ignition->cause == surface::IgnitionCause::trigger;
           return fmt::format("{} at {}, {}", by_trigger ? "T1 reached" : "Arrhenius runaway",
                              report::in_words(row.ignition->time, keys::fixed(3, keys::millisecond)),
                              row.ignition->point);
         }}}});
}

Json gap_json(const GapRow& row) {
  const auto json = [](const std::optional<study::Peak>& peak) {
    return peak ? report::json_of(peak_quantities(), *peak) : Json(nullptr);
  };
  Json object{{"gap_cm", report::shown_gap(row.gap->gap)},
              {"maximum", json(row.at_stations)},
              {"at_observation_points", json(row.at_points)},
              {"ignition", nullptr}};
  if (const auto& ignition = row.ignition)
    object["ignition"] = {{"ignition_cause", study::to_string(ignition->cause)},
                          {report::quantity::ignition_time.key(),
                           report::shown_value(ignition->time, report::quantity::ignition_time.form)},
                          {"ignition_place", ignition->point},
                          {"ignition_chemical_share", ignition->chemical_share}};
  return object;
}

Json energy_json(const run::EnergyBalance& energy) {
  return {{"kinetic_J", energy.kinetic},   {"internal_J", energy.internal},
          {"external_J", energy.external}, {"body_force_J", energy.body_force},
          {"damping_J", energy.damping},   {"contact_J", energy.contact},
          {"plastic_J", energy.plastic},   {"viscous_J", energy.viscous},
          {"crack_J", energy.crack},       {"drift", energy.drift()}};
}

/// A row a gap: highest temperatures, where and when, ignition.
report::Table gap_table(const scene::Scene& scene, const run::CaseResult& result) {
  const std::vector<GapRow> rows = rows_of(result);
  const bool points = std::ranges::any_of(rows, [](const GapRow& row) { return row.at_points.has_value(); });
  report::Table table = report::table_of(scene.title, gap_quantities(points), rows);
  if (const std::string edges = scene::charge_edges_off_grid(scene); !edges.empty())
    table.notes.push_back("The charge lies off the grid lines (" + edges +
                          "): calibrated constants do not carry over from a grid that fits.");
  table.notes.push_back(
      "T max is that of the hottest station; stations tile the charge's bottom, S1 at the wall, and verdicts "
      "use them. At a point beside the wall the stress is singular, and does not settle as cells shrink.");
  return table;
}

/// Warnings of a case, each after its name and a colon; those of a gap that burns after the gap.
std::vector<std::string> warnings_of(const scene::Scene& scene, const run::CaseResult& result) {
  std::vector<std::string> texts;
  for (const auto& warnings : {run::validity_warnings(scene, result.mechanics), run::launch_warnings(scene)})
    for (const run::Warning& each : warnings) texts.push_back(each.name + ": " + each.text);
  for (const run::GapResult& gap : result.gaps)
    if (gap.combustion)
      for (const std::string& each : run::combustion_validity_warnings(scene, *gap.combustion))
        texts.push_back(fmt::format("gap {:.6g} cm: {}", 100.0 * gap.gap, each));
  return texts;
}

/// For programs, in SI units but for the gaps (see the keys).
Json case_json(const scene::Scene& scene, const run::CaseResult& result) {
  const run::MechanicsResult& mechanics = result.mechanics;
  Json object{{"title", scene.title},
              {"status", run::to_string(mechanics.status)},
              {"reason", mechanics.reason},
              {"end_time_ms", report::shown_value(mechanics.end_time, report::quantity::time(2).form)},
              {"load", load_json(scene)},
              {"validity_warnings", warnings_of(scene, result)},
              {"gaps", Json::array()}};
  for (const GapRow& row : rows_of(result)) object["gaps"].push_back(gap_json(row));
  object["combustion"] = report::json_rows(report::combustion_table(result));
  if (!mechanics.monitor.empty()) object["energy"] = energy_json(mechanics.monitor.back().energy);
  object["effects"] = report::json_of(report::launch_effects(), mechanics);
  for (const run::Limiter& each : run::limiters)
    object["limiters"][each.name] = mechanics.limiters.*each.member;
  for (const run::MaterialMass& each : mechanics.masses) object["mass"][each.material + "_kg"] = each.mass;
  object["timing"] = {{"particles", mechanics.particles},
                      {"steps", mechanics.steps},
                      {"wall_time_s", mechanics.wall_time},
                      {"processor_time_s", mechanics.processor_time},
                      {"updates_per_second", mechanics.update_rate()}};
  return object;
}

/// The gaps, and what burnt in them.
std::vector<report::Table> tables_of(const scene::Scene& scene, const run::CaseResult& result) {
  std::vector<report::Table> tables;
  if (!result.gaps.empty()) tables = {gap_table(scene, result), report::combustion_table(result)};
  std::erase_if(tables, [](const report::Table& table) { return table.rows.empty(); });
  return tables;
}

/// The launch, a table of the gaps, then the energy balance, the limiters that acted, and what the run cost.
/// `facts`: those for programs.
std::string case_text(const scene::Scene& scene, const run::CaseResult& result, Json facts) {
  const run::MechanicsResult& mechanics = result.mechanics;
  std::vector<std::string> masses;
  for (const run::MaterialMass& each : mechanics.masses)
    masses.push_back(fmt::format("{} {:.6g}", each.material, each.mass));
  facts.update({{"exit", scene::exit_text(scene)},
                {"end", scene::end_text(scene)},
                {"measured", scene::smoothing_text(scene.load)},
                {"completed", mechanics.status == run::RunStatus::completed},
                {"limited", run::to_string(mechanics.limiters)},
                {"simulated", scene::time_text(mechanics.end_time)},
                {"masses", masses}});
  for (const report::Table& table : tables_of(scene, result))
    facts["tables"].push_back(report::to_text(table, width_of_output()));
  if (!mechanics.monitor.empty())
    facts["drift"] =
        report::in_words(mechanics.monitor.back().energy.drift(), keys::significant(3, keys::percent));
  return told("run.txt", facts);
}

run::CaseResult run_with_progress(const scene::Scene& scene, const Console& console) {
  Progress progress(console.quiet());
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &stop_requested;
  const double end = scene::end_time(scene.load);
  options.progress = [&, end](double share) {
    constexpr double too_early = 0.005;  // to say what is left
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const std::string left = share > too_early && share <= 1.0
                                 ? report::duration(elapsed.count() * (1.0 - share) / share) + " left"
                                 : "";
    progress.show(fmt::format("{} of {}, {:.0f} %  {}", scene::time_text(share * end), scene::time_text(end),
                              100.0 * share, left));
  };
  return run::run_case(scene, options);
}

ExitCode perform(const RunArguments& arguments, Console& console) {
  const scene::SceneFile file = scene::read_scene(arguments.scene);
  const scene::Scene& scene = file.scene;
  store::Manifest manifest = store::make_manifest(scene::to_toml(scene));
  path target;
  if (arguments.output) {
    std::string name = arguments.scene.stem();
    for (char& letter : name)  // that XDMF takes for another
      if (std::string_view(":<>&\"").find(letter) != std::string_view::npos) letter = '_';
    target = *arguments.output / (name + ".h5");
    for (const path& each : {target, store::sidecar_of(target)})  // found out before anything is computed
      if (std::filesystem::exists(each)) throw store::refusal(each, "is there");
    prepare_output_folder(*arguments.output);
  }
  run::CaseResult result = run_with_progress(scene, console);
  const run::MechanicsResult& mechanics = result.mechanics;
  if (mechanics.status == run::RunStatus::interrupted)
    throw Ended{fmt::format("interrupted at {} of {}; nothing of this case was kept; to start it again: {}",
                            scene::time_text(mechanics.end_time),
                            scene::time_text(scene::end_time(scene.load)), arguments.command),
                ExitCode::interrupted};
  Json object = case_json(scene, result);
  object["kinetics"] = report::kinetics_json(file);
  object["input_sha256"] = manifest.input_sha256;
  object["file"] = target.string();
  const std::string text = case_text(scene, result, object);
  const bool finite = std::ranges::all_of(
      result.gaps, [](const run::GapResult& gap) { return std::isfinite(gap.at_stations.temperature); });
  const std::string early =
      mechanics.status == run::RunStatus::completed
          ? ""
          : fmt::format("the run ended early ({}): {}", run::to_string(mechanics.status), mechanics.reason);
  if (!target.empty()) {
    manifest.wall_time = mechanics.wall_time;
    store::write_case_file(target, {manifest, std::move(result)});
    console.remark(fmt::format("wrote {}", target.string()));
  }
  console.done(text, object);
  if (!finite) throw Ended{"a skin temperature is not a number", ExitCode::cases_failed};
  if (!early.empty()) throw Ended{early, ExitCode::cases_failed};
  return ExitCode::done;
}

}  // namespace

void add_run(CLI::App& app, CommandLine& line) {
  auto [command, run] = add_command<RunArguments>(
      app, line, "run", "Run one case: a scene in, temperatures of the charge bottom out");
  add(command, "scene", run.scene, "SCENE.toml", "Scene file")->required();
  add(command, "-o,--output", run.output, "DIR", "Folder to write the HDF5 case file to");
}

}  // namespace launchsafe::app
