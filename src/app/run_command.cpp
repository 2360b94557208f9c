// launchsafe run: one case.
#include "built_in_texts.hpp"
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/study/gap_verdict.hpp"
#include "launchsafe/study/scheduler.hpp"
#include "output_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <chrono>
#include <cmath>

namespace launchsafe::app {
namespace {

struct RunArguments {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> output;  ///< folder of the case file; none: nothing is written
  std::optional<double> longest_run;            ///< s, predicted; a longer one is refused
};

bool has_observation_points(const trace::BottomTrace& trace) {
  return std::ranges::any_of(trace.stations,
                             [](const trace::Station& station) { return station.observation; });
}

std::string place_of(const trace::BottomTrace& trace, std::size_t index) {
  if (index >= trace.stations.size()) return "";
  return trace.stations[index].name;
}

std::string ignition_text(const std::optional<surface::Ignition>& ignition, const trace::BottomTrace& trace) {
  if (!ignition) return "none";
  const bool by_trigger = ignition->cause == surface::IgnitionCause::trigger;
  return fmt::format("{} at {}, {}", by_trigger ? "T1 reached" : "Arrhenius runaway",
                     report::in_words(ignition->time, keys::fixed(3, keys::millisecond)),
                     place_of(trace, ignition->station));
}

std::string kilojoules(double joules) {
  return report::in_words(joules, keys::significant(6, keys::kilojoule));
}

report::Table air_table(const scene::Scene& scene, const run::CaseResult& result) {
  std::vector<report::AuditedGap> gaps;
  for (const run::GapResult& gap : result.gaps) gaps.push_back({"", gap.gap, gap.air});
  return report::air_energy_table(scene.surface.air_model, gaps);
}

/// A maximum, and the trace that knows its place; nothing of one that does not exist.
struct MaximumRow {
  const surface::Maximum* maximum;
  const trace::BottomTrace* trace;
};

/// `heading`: what temperature, place and instant are called.
report::Quantities<MaximumRow> maximum_quantities(const std::array<const char*, 3>& heading) {
  using namespace report::quantity;
  const auto place = [](const MaximumRow& row) {
    return row.maximum != nullptr ? report::Cell(place_of(*row.trace, row.maximum->station)) : report::Cell();
  };
  return {{headed(heading[0], temperature_max), &MaximumRow::maximum, &surface::Maximum::temperature},
          {headed(heading[1], temperature_max_place), place},
          {headed(heading[2], temperature_max_time), &MaximumRow::maximum, &surface::Maximum::time}};
}

/// One gap of a run.
struct GapRow {
  const run::GapResult* gap;
  const trace::BottomTrace* trace;

  MaximumRow at_stations() const { return {trace->stations.empty() ? nullptr : &gap->at_stations, trace}; }
  MaximumRow at_points() const { return {&gap->at_points, trace}; }
};

report::Quantities<GapRow> gap_quantities(bool points) {
  report::Quantities<GapRow> quantities = keys::joined<GapRow>(
      {{{report::quantity::gap, &GapRow::gap, &run::GapResult::gap}},
       report::of_part<GapRow>(maximum_quantities({"T max", "at", "time"}), &GapRow::at_stations)});
  if (points)
    quantities = keys::joined<GapRow>(
        {quantities, report::of_part<GapRow>(maximum_quantities({"T max at points", "where", "when"}),
                                             &GapRow::at_points)});
  quantities.emplace_back(
      report::Column{"ignition", "ignition", keys::text(), "Cause, instant and station of ignition."},
      [](const GapRow& row) { return ignition_text(row.gap->skin.ignition, *row.trace); });
  return quantities;
}

Json maximum_json(const surface::Maximum& maximum, const trace::BottomTrace& trace) {
  return report::json_of(maximum_quantities({"T max", "at", "time"}), MaximumRow{&maximum, &trace});
}

Json ignition_json(const std::optional<surface::Ignition>& ignition, const trace::BottomTrace& trace) {
  if (!ignition) return nullptr;
  return {{"ignition_cause", study::to_string(ignition->cause)},
          {report::quantity::ignition_time.key(),
           report::shown_value(ignition->time, report::quantity::ignition_time.form)},
          {"ignition_place", place_of(trace, ignition->station)},
          {"ignition_chemical_share", ignition->chemical_share}};
}

Json gap_json(const run::GapResult& gap, const run::MechanicsResult& mechanics) {
  const trace::BottomTrace& trace = mechanics.trace;
  const bool observed = has_observation_points(trace);
  Json object{{"gap_cm", report::shown_gap(gap.gap)}};
  object["maximum"] = maximum_json(gap.at_stations, trace);
  object["at_observation_points"] = observed ? maximum_json(gap.at_points, trace) : Json(nullptr);
  object["ignition"] = ignition_json(gap.skin.ignition, trace);
  object["sampling_error_K"] = gap.sampling_error;
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
  const trace::BottomTrace& trace = result.mechanics.trace;
  std::vector<GapRow> rows;
  for (const run::GapResult& gap : result.gaps) rows.push_back({&gap, &trace});
  report::Table table = report::table_of(scene.title, gap_quantities(has_observation_points(trace)), rows);
  if (const std::string edges = scene::charge_edges_off_grid(scene); !edges.empty())
    table.notes.push_back("The charge lies off the grid lines (" + edges +
                          "): calibrated constants do not carry over from a grid that fits.");
  table.notes.push_back(
      "T max is that of the hottest station; stations tile the charge's bottom, S1 at the wall, and verdicts "
      "use them. At a point beside the wall the stress is singular, and does not settle as cells shrink.");
  return table;
}

/// For programs, in SI units but for the gaps (see the keys).
Json case_json(const scene::Scene& scene, const run::CaseResult& result) {
  const run::MechanicsResult& mechanics = result.mechanics;
  Json object{{"title", scene.title},
              {"status", run::to_string(mechanics.status)},
              {"reason", mechanics.reason},
              {"end_time_ms", report::shown_value(mechanics.end_time, report::quantity::time(2).form)},
              {"load", load_json(scene)},
              {"gaps", Json::array()}};
  for (const run::GapResult& gap : result.gaps) object["gaps"].push_back(gap_json(gap, mechanics));
  object["combustion"] = report::json_rows(report::combustion_table(scene, result));
  object["air_energy"] = report::json_rows(air_table(scene, result));
  object["closing"] = report::json_rows(report::closing_table(result));
  if (!mechanics.monitor.empty()) object["energy"] = energy_json(mechanics.monitor.back().energy);
  object["interfaces"] = report::json_rows(report::interface_table(mechanics));
  object["limiters"] = {{"crack_at_bound", mechanics.limiters.crack_at_bound},
                        {"tension_cutoff", mechanics.limiters.tension_cutoff},
                        {"hugoniot_guard", mechanics.limiters.hugoniot_guard}};
  for (const run::MaterialMass& each : mechanics.masses) object["mass"][each.material + "_kg"] = each.mass;
  object["timing"] = {{"particles", mechanics.particles},
                      {"steps", mechanics.steps},
                      {"wall_time_s", mechanics.wall_time},
                      {"processor_time_s", mechanics.processor_time},
                      {"updates_per_second", mechanics.update_rate()}};
  return object;
}

/// The gaps, what burnt in them, and the faces that slide.
std::vector<report::Table> tables_of(const scene::Scene& scene, const run::CaseResult& result) {
  constexpr std::size_t history_rows = 12;
  std::vector<report::Table> tables;
  if (!result.gaps.empty()) {
    const bool closes = scene.surface.model == scene::GapModel::closing;
    tables = {gap_table(scene, result), closes ? report::closing_table(result) : air_table(scene, result)};
    if (report::Table burnt = report::combustion_table(scene, result); !burnt.rows.empty())
      tables.push_back(std::move(burnt));
    for (const run::GapResult& gap : result.gaps)
      if (gap.combustion)
        tables.push_back(report::combustion_history_table(*gap.combustion, gap.gap, history_rows));
  }
  if (report::Table faces = report::interface_table(result.mechanics); !faces.rows.empty())
    tables.push_back(std::move(faces));
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
                {"measured", scene::measured_load_text(scene.load)},
                {"completed", mechanics.status == run::RunStatus::completed},
                {"limited", report::acted(mechanics.limiters)},
                {"simulated", scene::time_text(mechanics.end_time)},
                {"masses", masses},
                {"axisymmetric", scene.symmetry == scene::Symmetry::axisymmetric},
                {"wall_time", report::duration(mechanics.wall_time)},
                {"updates", fmt::format("{:.2f}", mechanics.update_rate() / 1e6)}});
  if (mechanics.processor_time > 0) facts["processor_time"] = report::duration(mechanics.processor_time);
  for (const report::Table& table : tables_of(scene, result))
    facts["tables"].push_back(report::to_text(table, width_of_output()));
  if (mechanics.monitor.empty()) return told("run.txt", facts);
  const run::EnergyBalance& energy = mechanics.monitor.back().energy;
  for (auto& [key, value] : facts["energy"].items()) value = kilojoules(value.get<double>());
  if (energy.contact == 0.0) facts["energy"].erase("contact_J");
  facts["energy"]["drift"] = report::in_words(energy.drift(), keys::significant(3, keys::percent));
  facts["energy"]["scale"] = kilojoules(energy.scale());
  return told("run.txt", facts);
}

/// "12 s left" when a share 0..1 took `elapsed` seconds; "" while it is too early to say.
std::string time_left(double share, double elapsed) {
  constexpr double too_early = 0.005;
  if (!(share > too_early) || share > 1.0) return {};
  return fmt::format("{} left", report::duration(elapsed * (1.0 - share) / share));
}

run::CaseResult run_with_progress(const scene::Scene& scene, const Console& console) {
  Progress progress(console.quiet());
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &stop_requested();
  options.threads = study::threads_for_one_run(scene::particle_count(scene));
  const double end = scene::end_time(scene.load);
  options.progress = [&, end](double share) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    progress.show(fmt::format("{} of {}, {:.0f} %  {}", scene::time_text(share * end), scene::time_text(end),
                              100.0 * share, time_left(share, elapsed.count())));
  };
  return run::run_case(scene, options);
}

ExitCode report_interruption(const RunArguments& arguments, const run::MechanicsResult& mechanics,
                             const scene::Scene& scene, Console& console) {
  const std::string output = arguments.output ? fmt::format(" -o {}", arguments.output->string()) : "";
  const double end = scene::end_time(scene.load);
  // What follows the launch was interrupted where the launch itself is over.
  const std::string where =
      mechanics.end_time < end
          ? fmt::format("at {} of {}", scene::time_text(mechanics.end_time), scene::time_text(end))
          : mechanics.reason;
  console.error(
      fmt::format("interrupted {}; nothing of this case was kept; to start it again: launchsafe run {}{}",
                  where, arguments.scene.string(), output));
  return ExitCode::interrupted;
}

/// The words of the events that a snapshot was asked of and that did not happen.
std::vector<std::string> missing_events(const scene::Scene& scene, const run::CaseResult& result) {
  std::vector<std::string> words;
  for (const scene::Event event : run::events_without_snapshot(scene, result))
    words.push_back(scene::word_of(event));
  return words;
}

ExitCode perform(const RunArguments& arguments, Console& console) {
  const scene::SceneFile file = console.value_of(scene::read_scene(arguments.scene));
  for (const std::string& note : file.notes) console.remark(note);
  const scene::Scene& scene = file.scene;
  run::Reach reach{.memory = study::available_memory(), .keeps_skins = true};
  if (arguments.longest_run) reach.longest_run = *arguments.longest_run;
  if (const auto error = run::out_of_reach(file, reach)) return console.refuse(*error);
  store::Manifest manifest = store::make_manifest(scene::to_toml(scene), 1);
  std::filesystem::path target;
  if (arguments.output) {
    target = *arguments.output / arguments.scene.stem().concat(".h5");
    // Found out before anything is computed.
    auto error = store::obstacle_to_case_file(target, manifest);
    if (!error && scene.output.asks_for_snapshots()) error = store::obstacle_to_sidecar(target);
    if (error) return console.refuse(error->message);
    if (const auto obstacle = prepare_output_folder(*arguments.output)) return console.refuse(*obstacle);
  }
  for (const scene::Implausible& each : scene::implausible_values(scene)) {
    if (!each.accepted()) console.remark("validity warning: " + scene::validity_warning(each));
  }
  const run::CaseResult result = run_with_progress(scene, console);
  for (const run::GapResult& gap : result.gaps)
    if (gap.combustion)
      for (const std::string& each : run::combustion_validity_warnings(scene, *gap.combustion))
        console.remark(fmt::format("validity warning: gap {:.6g} cm: {}", 100.0 * gap.gap, each));
  manifest.wall_time = result.mechanics.wall_time;
  if (result.mechanics.status == run::RunStatus::interrupted) {
    return report_interruption(arguments, result.mechanics, scene, console);
  }
  if (!target.empty()) {
    if (const auto error = store::write_case_file(target, scene, result, manifest))
      return console.end_with(*error);
    console.remark(fmt::format("wrote {}", target.string()));
  }
  const std::vector<std::string> missing = missing_events(scene, result);
  if (!missing.empty())
    console.remark(fmt::format("no snapshot of {}: it did not happen", fmt::join(missing, ", ")));
  Json object = case_json(scene, result);
  console.print_text(case_text(scene, result, object));
  object["events_without_snapshot"] = missing;
  object["implausible"] = plausibility_json(scene);
  object["input_sha256"] = manifest.input_sha256;
  object["file"] = target.empty() ? Json(nullptr) : Json(target.string());
  console.print_json(object);
  const bool finite = std::ranges::all_of(
      result.gaps, [](const run::GapResult& gap) { return std::isfinite(gap.at_stations.temperature); });
  if (!finite) {
    console.error("a skin temperature is not a number; every verdict on it is indeterminate");
    return ExitCode::indeterminate;
  }
  if (result.mechanics.status == run::RunStatus::completed) return ExitCode::done;
  console.error(fmt::format("the run ended early ({}): {}; every verdict on it is indeterminate",
                            run::to_string(result.mechanics.status), result.mechanics.reason));
  return ExitCode::indeterminate;
}

}  // namespace

void add_run(CLI::App& app, CommandLine& line) {
  auto [command, run] = add_command<RunArguments>(
      app, line, "run", "Run one case: a scene in, temperatures of the charge bottom out");
  add_required(command, "scene", run.scene, "SCENE.toml", "Scene file");
  add_folder(command, run.output, "Folder to write the HDF5 case file to");
  add_longest_run(command, run.longest_run);
}

}  // namespace launchsafe::app
