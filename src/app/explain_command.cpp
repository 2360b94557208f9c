// launchsafe explain: what would be computed, and at what cost.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::app {
namespace {

/// More than fit into a core's own cache, and few enough to be made in a moment.
constexpr std::int64_t most_particles = 50'000;

/// The scene on a mesh of so few particles, recording next to nothing.
scene::Scene measurable(scene::Scene scene) {
  constexpr double largest_cell = 1.0;  // m
  while (scene::particle_count(scene) > most_particles && scene.numerics.cell_size < largest_cell)
    scene.numerics.cell_size *= std::sqrt(2.0);
  scene.output.snapshot_times.clear();
  scene.output.snapshot_events.clear();
  scene.output.trace_interval = scene::end_time(scene.load);
  return scene;
}

ExitCode explain_scene(const path& place, Console& console) {
  const scene::SceneFile file = console.value_of(scene::read_scene(place));
  const scene::Scene& scene = file.scene;
  const double update_rate = measured_update_rate(scene, console);
  Json facts = scene_json(scene, update_rate);
  facts["kinetics"] = report::kinetics_json(file);
  return console.done(scene_text(scene, facts), facts);
}

ExitCode explain_study(const path& place, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(place));
  const Json facts = estimate_json(file, {}, console);
  return console.done(estimate_text(file, facts), facts);
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

Json estimate_json(const study::StudyFile& file, const study::StudyOptions& options, Console& console) {
  const double rate = measured_update_rate(file.cases.front().scene.scene, console);
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

double measured_update_rate(const scene::Scene& scene, Console& console) {
  std::atomic<bool> enough{false};
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &enough;
  options.progress = [&](double) {
    if (std::chrono::steady_clock::now() - start > std::chrono::milliseconds(300) || stop_requested())
      enough = true;
  };
  const run::MechanicsResult run = run::run_mechanics(measurable(scene), options);
  // What is predicted is wall time, on a machine as busy as it is.
  const double rate = run.wall_time > 0.0 ? run.particle_updates() / run.wall_time : 0.0;
  if (stop_requested())
    console.fail("interrupted while measuring the speed of this machine; there is nothing to keep",
                 ExitCode::interrupted);
  return rate > 0.0 ? rate : run::cautious_update_rate;  // where the run breaks at its first step
}

ExitCode perform(const ExplainArguments& arguments, Console& console) {
  if (!arguments.lists() && arguments.file.empty())
    console.refuse("explain: allowed: a scene or study, or one of --keys, --results and --warnings" +
                   usage_hint("explain "));
  if (arguments.lists()) return explain_program(arguments, console);
  if (scene::content_of(arguments.file) != scene::InputContent::study)
    return explain_scene(arguments.file, console);
  return explain_study(arguments.file, console);
}

void add_explain(CLI::App& app, CommandLine& line) {
  auto [command, explain] = add_command<ExplainArguments>(app, line, "explain");
  add(command, "file", explain.file);
  CLI::Option* keys = add(command, "--keys", explain.keys);
  CLI::Option* results = add(command, "--results", explain.results)->excludes(keys);
  add(command, "--warnings", explain.warnings)->excludes(keys)->excludes(results);
}

}  // namespace launchsafe::app
