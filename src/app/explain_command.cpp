// launchsafe explain: what would be computed, and at what cost.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::app {
namespace {

struct ExplainArguments {
  path file;  ///< scene or study; with one of the lists a part of names, or empty for all
  bool keys = false, results = false, warnings = false;
};

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run, on a coarser mesh where its own has very many particles.
double measured_update_rate(scene::Scene scene) {
  constexpr std::int64_t most_particles = 50'000;  // more than fit into a core's own cache, made in a moment
  while (scene::particle_count(scene) > most_particles && scene.numerics.cell_size < 1.0)
    scene.numerics.cell_size *= std::sqrt(2.0);
  scene.output.snapshot_times.clear();
  scene.output.snapshot_events.clear();
  scene.output.trace_interval = scene::end_time(scene.load);
  std::atomic<bool> enough{false};
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &enough;
  options.progress = [&](double) {
    if (std::chrono::steady_clock::now() - start > std::chrono::milliseconds(300) || stop_requested)
      enough = true;
  };
  const run::MechanicsResult run = run::run_mechanics(scene, options);
  // What is predicted is wall time, on a machine as busy as it is.
  const double rate = run.wall_time > 0.0 ? run.particle_updates() / run.wall_time : 0.0;
  if (stop_requested)
    throw Ended{"interrupted while measuring the speed of this machine", ExitCode::interrupted};
  return rate > 0.0 ? rate : run::cautious_update_rate;  // where the run breaks at its first step
}

ExitCode explain_scene(const path& place, Console& console) {
  const scene::SceneFile file = scene::read_scene(place);
  Json facts = scene_json(file.scene, measured_update_rate(file.scene));
  facts["kinetics"] = report::kinetics_json(file);
  return console.done(scene_text(file.scene, facts), facts);
}

ExitCode explain_study(const path& place, Console& console) {
  const study::StudyFile file = kinds::read_study(place).or_throw();
  const Json facts = estimate_json(file, {});
  return console.done(estimate_text(file, facts), facts);
}

// --- lists ---

void check_found(bool any, const std::string& part) {
  if (!any)
    throw Ended{fmt::format("explain: found \"{}\", which no name has; allowed: a part of a name", part)};
}

Json listed(const std::vector<scene::DocumentedKey>& keys, const std::string& part) {
  Json rows = Json::array();
  for (const auto& [described, default_text] : keys)
    if (described.name.find(part) != std::string::npos)
      rows.push_back({{"key", described.name},
                      {"si_unit", scene::si_unit_of(described.dimension)},
                      {"allowed", scene::allowed_text(described)},
                      {"default", default_text},
                      {"required", described.required},
                      {"standing", scene::letter_of(described.standing)},
                      {"sentence", described.sentence}});
  return rows;
}

/// The keys of scene and study files, from the same descriptions that read them.
ExitCode explain_keys(const std::string& part, Console& console) {
  using enum scene::Standing;
  const Json rows{{"keys", listed(scene::describe_keys(), part)},
                  {"study_keys", listed(kinds::describe_study_keys(), part)}};
  check_found(!rows["keys"].empty() || !rows["study_keys"].empty(), part);
  Json facts;
  for (const scene::Standing standing : {paper, literature, derived, assumed, calibrated})
    facts["standings"].push_back(
        fmt::format("[{}] {}", scene::letter_of(standing), scene::meaning_of(standing)));
  for (const auto& [name, list] : rows.items()) facts[name] = told("key_list.txt", {{"rows", list}});
  return console.done(told("keys.txt", facts), rows);
}

/// Every column of the tables of all kinds, from the same descriptions that write them.
ExitCode explain_results(const std::string& part, Console& console) {
  Json list = Json::array();
  for (const kinds::Kind& kind : kinds::kinds()) {
    for (const report::ReportTable& table : kind.results()) {
      Json columns = Json::array();
      for (const report::Column& column : table.table.columns)
        if (column.key().find(part) != std::string::npos)
          columns.push_back({{"key", column.key()},
                             {"name", column.heading},
                             {"unit", column.form.unit},
                             {"meaning", column.meaning}});
      if (!columns.empty())
        list.push_back(
            {{"kind", kind.traits.name}, {"member", table.member}, {"csv", table.csv}, {"columns", columns}});
    }
  }
  check_found(!list.empty(), part);
  return console.done(told("results.txt", {{"tables", list}}), {{"results", list}});
}

/// Every validity warning on a line of its own.
ExitCode explain_warnings(Console& console) {
  Json list = Json::array();
  std::string text;
  for (const run::WarningKind& kind : run::warning_kinds()) {
    list.push_back({{"name", kind.name}, {"acceptable", kind.acceptable}, {"meaning", kind.meaning}});
    text += fmt::format("{:<20} {:<14} {}\n", kind.name, kind.acceptable ? "acceptable" : "not acceptable",
                        kind.meaning);
  }
  return console.done(text, {{"warnings", list}});
}

ExitCode perform(const ExplainArguments& arguments, Console& console) {
  if (arguments.keys) return explain_keys(arguments.file, console);
  if (arguments.results) return explain_results(arguments.file, console);
  if (arguments.warnings) return explain_warnings(console);
  if (arguments.file.empty())
    throw Ended{"explain: allowed: a scene or study, or one of --keys, --results and --warnings"};
  const bool is_study = scene::content_of(scene::parse_toml(scene::read_text_file(arguments.file),
                                                            arguments.file)) == scene::InputContent::study;
  return is_study ? explain_study(arguments.file, console) : explain_scene(arguments.file, console);
}

}  // namespace

std::string estimate_text(const study::StudyFile& file, Json facts) {
  facts.update({{"scene", file.study.scene},
                {"judges_gaps", file.study.kind.judges_gaps},
                {"combustion", scene::time_text(file.scene.scene.combustion.duration)}});
  for (const auto& [key, value] : file.overrides)
    facts["overrides"].push_back(fmt::format("{:<19} {}", key, value));
  return told("estimate.txt", facts);
}

Json estimate_json(const study::StudyFile& file, const study::StudyOptions& options) {
  const double rate = measured_update_rate(file.cases.front().scene.scene);
  const study::Estimate estimate = study::estimate_of(file, options);
  return {{"title", file.study.title},
          {"kind", file.study.kind.name},
          {"kinetics", report::kinetics_json(file.scene)},
          {"cases", estimate.cases},
          {"mechanical_runs", estimate.runs},
          {"stored", estimate.stored},
          {"to_run", estimate.runs - estimate.stored},
          {"coupled_runs_at_most", estimate.coupled_runs},
          {"gaps", file.study.gaps.size()},
          {"jobs", estimate.jobs},
          {"particle_updates", estimate.updates},
          {"updates_per_second", rate},
          {"memory_bytes", estimate.memory},
          {"predicted_time_s", estimate.time(rate)}};
}

void add_explain(CLI::App& app, CommandLine& line) {
  auto [command, explain] = add_command<ExplainArguments>(
      app, line, "explain", "Print what a scene or a study will compute, what it leaves out, and the cost");
  add(command, "file", explain.file, "SCENE.toml|STUDY.toml",
      "Scene or study; with --keys or --results a part of names, such as load");
  command.add_flag("--keys", explain.keys, "List the keys of scene and study files");
  command.add_flag("--results", explain.results, "List the columns of results");
  command.add_flag("--warnings", explain.warnings, "List the validity warnings");
}

}  // namespace launchsafe::app
