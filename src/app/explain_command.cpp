// launchsafe explain: what would be computed, and at what cost.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::app {
namespace {

// --- what a study will run, and at what cost ---

using study::Forecast, study::ForecastRun;

report::Table run_table(const std::vector<ForecastRun>& runs) {
  using keys::fixed;
  const report::Quantities<ForecastRun> quantities{
      {{"mechanical_run", "mechanical run", keys::text(), "The run."}, &ForecastRun::label},
      {{"cases", "cases", keys::count(), "Cases that share it."}, &ForecastRun::cases},
      {report::quantity::particles, &ForecastRun::particles},
      {report::quantity::steps, &ForecastRun::steps},
      {report::quantity::memory, &ForecastRun::memory},
      {{"time", "time", fixed(1, keys::second), "Time that it takes, as estimated."}, &ForecastRun::time},
      {{"shard", "shard", keys::count(), "Shard that runs it."}, &ForecastRun::shard},
      {{"state", "state", keys::text(), "Whether it is stored, or why it runs."},
       [](const ForecastRun& run) { return run.stored || run.given_up ? run.why : "to run: " + run.why; }}};
  return report::table_of({}, quantities, runs);
}

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

// --- what is not plausible ---

std::string line_of(const scene::Implausible& value) {
  if (value.accepted()) return scene::accepted_text({value});
  return fmt::format("validity warning: {}{}", scene::validity_warning(value),
                     value.suggestion.empty() ? "" : fmt::format("; did you mean \"{}\"?", value.suggestion));
}

/// A study of the scene alone, under the shipped calibration.
study::StudyFile study_of(const scene::SceneFile& file) {
  study::StudyFile alone;
  alone.study.kind.gives_verdicts = scene::has_charge(file.scene);
  study::StudyCase only;
  only.scene = alone.scene = file;
  alone.cases.add(std::move(only));
  return alone;
}

/// What is not plausible; what is to be accepted, ready to copy; and acceptances that accept nothing.
std::string checks_text(const std::vector<std::string>& implausible, const study::AcceptancesOfStudy& all) {
  return told("checks.txt", {{"plausibility", implausible},
                             {"missing", scene::acceptances_to_write(all.missing)},
                             {"unneeded", all.unneeded}});
}

/// One sentence for every value that is not plausible, of the cases of a study and of what it states itself,
/// with the number of several cases. Empty for a kind that gives no verdicts on scenes of its own.
std::vector<std::string> plausibility_lines(const study::StudyFile& study) {
  if (!study.study.kind.gives_verdicts && study.study.kind.own_scenes) return {};
  std::vector<std::string> lines = study::of_each(study.study.implausible, line_of);
  std::vector<std::string> order;
  std::map<std::string, std::size_t> cases;
  for (const study::StudyCase& each : study.cases) {
    for (const scene::Implausible& value : scene::implausible_values(each.scene.scene)) {
      const std::string line = line_of(value);
      if (++cases[line] == 1) order.push_back(line);
    }
  }
  // A sensitivity study may have another value in every case.
  constexpr std::size_t most_lines = 20;
  for (std::size_t i = 0; i < std::min(order.size(), most_lines); ++i)
    lines.push_back(study.cases.size() == 1
                        ? order[i]
                        : fmt::format("{} ({} of {} cases)", order[i], cases[order[i]], study.cases.size()));
  if (order.size() > most_lines)
    lines.push_back(fmt::format("and {} other values like these", order.size() - most_lines));
  return lines;
}

/// Writes the half section and the grid.
void draw_grid(const path& picture, const scene::Scene& scene, Console& console) {
  if (picture.extension() != ".svg")
    console.refuse(fmt::format("--grid: found \"{}\"; allowed: the name of an SVG file, such as grid.svg",
                               picture.string()));
  write_where_absent(store::folder_of(picture), {{picture.filename(), report::section_svg(scene)}}, console);
  console.remark(fmt::format("wrote {}", picture.string()));
}

ExitCode explain_scene(const ExplainArguments& arguments, Console& console) {
  const scene::SceneFile file = console.value_of(scene::read_scene(arguments.file));
  const scene::Scene& scene = file.scene;
  console.remarks(file.notes);
  if (arguments.picture) draw_grid(*arguments.picture, scene, console);
  const double update_rate = measured_update_rate(scene, console);
  const study::StudyFile alone = study_of(file);
  Json facts = scene_json(scene, update_rate);
  facts["kinetics"] = report::kinetics_json(file);
  return console.done(
      scene_text(scene, facts) + checks_text(plausibility_lines(alone), study::acceptances_of(alone)), facts);
}

ExitCode explain_study(const path& place, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(place));
  console.remarks(file.scene.notes);
  const Forecast forecast =
      study::forecast_study(file, {}, measured_update_rate(file.cases.front().scene.scene, console));
  const Json facts = forecast_json(file, forecast);
  return console.done(forecast_text(file, forecast, facts, {}), facts);
}

/// What of these options makes no sense together; empty for nothing.
std::string contradiction(const ExplainArguments& explain) {
  if (!explain.lists() && explain.file.empty())
    return "explain: allowed: a scene or study, or one of --keys and --results";
  if (explain.picture && explain.lists())
    return "explain: --grid draws the grid of a scene; allowed: with a scene file";
  return {};
}

}  // namespace

std::string forecast_text(const study::StudyFile& file, const Forecast& forecast, Json facts,
                          const path& folder, std::optional<std::time_t> begin) {
  const scene::Scene& scene = file.scene.scene;
  // Those of a large study fill no terminal.
  const auto listed = static_cast<std::ptrdiff_t>(std::min<std::size_t>(20, forecast.runs.size()));
  facts.update({{"scene", file.study.scene},
                {"folder", folder.string()},
                {"judges_gaps", file.study.kind.judges_gaps},
                {"combustion", scene::time_text(scene.combustion.duration)},
                {"some_left_out", facts["stored"] != 0 || facts["refused"] != 0},
                {"list", report::to_text(run_table({forecast.runs.begin(), forecast.runs.begin() + listed}),
                                         width_of_output())}});
  if (static_cast<std::size_t>(listed) < forecast.run_count)
    facts["list"].get_ref<std::string&>() +=
        fmt::format("and {} more; --json lists {}\n", forecast.run_count - static_cast<std::size_t>(listed),
                    forecast.runs.size());
  facts[facts["refused"] != 0 && facts["to_run"] == 0 ? "may_not_run"
        : facts["stored"] == forecast.run_count       ? "all_stored"
                                                      : "takes_time"] = true;
  if (begin && forecast.time > 0)
    facts["end"] = report::clock_time(*begin + static_cast<std::time_t>(forecast.time), *begin);
  for (const auto& [key, value] : file.overrides)
    facts["overrides"].push_back(fmt::format("{:<19} {}", key, value));
  return told("forecast.txt", facts) + checks_text(facts["implausible"], study::acceptances_of(file));
}

Json forecast_json(const study::StudyFile& file, const Forecast& forecast) {
  std::size_t stored = 0, refused = 0, to_run = 0;
  double updates = 0;  // of particles, in the runs that are left
  for (const ForecastRun& run : forecast.runs) {
    ++(run.refused ? refused : run.stored || run.given_up ? stored : to_run);
    if (!run.stored && !run.given_up)
      updates += static_cast<double>(run.particles) * static_cast<double>(run.steps);
  }
  if (!forecast.runs.empty())
    updates *= static_cast<double>(forecast.run_count) / static_cast<double>(forecast.runs.size());
  return {{"title", file.study.title},
          {"kind", file.study.kind.name},
          {"kinetics", report::kinetics_json(file.scene)},
          {"cases", forecast.cases},
          {"mechanical_runs", forecast.run_count},
          {"estimated_from_runs", forecast.runs.size()},
          {"stored", forecast.of_all(stored)},
          {"to_run", forecast.of_all(to_run)},
          {"refused", forecast.of_all(refused)},
          {"coupled_runs_at_most", forecast.confirmations},
          {"gaps", file.study.gaps.size()},
          {"jobs", forecast.jobs},
          {"particle_updates", updates},
          {"updates_per_second", forecast.update_rate},
          {"rate_learned_from_runs", forecast.learned_from},
          {"memory_bytes", forecast.memory},
          {"disk_bytes", forecast.disk},
          {"predicted_time_s", forecast.time},
          {"predicted_time_of_coupled_runs_s", forecast.confirmation_time},
          {"implausible", plausibility_lines(file)},
          {"runs", report::json_rows(run_table(forecast.runs))}};
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
  if (const std::string fault = contradiction(arguments); !fault.empty())
    console.refuse(fault + usage_hint("explain "));
  if (arguments.lists()) return explain_program(arguments, console);
  std::error_code unknown;  // a name that is too long, say: reading it tells
  if (const std::string word = arguments.file.string();
      !std::filesystem::exists(arguments.file, unknown) &&
      (scene::has_key(scene::describe_keys(), word) || scene::has_key(kinds::describe_study_keys(), word)))
    console.refuse(
        fmt::format("explain: found no file \"{0}\"; of keys tells: launchsafe explain --keys {0}", word));
  if (scene::content_of(arguments.file) != scene::InputContent::study)
    return explain_scene(arguments, console);
  if (arguments.picture)
    console.refuse(
        fmt::format("--grid: found {}, which is no scene; allowed: a scene, such as that of a study",
                    arguments.file.string()));
  return explain_study(arguments.file, console);
}

void add_explain(CLI::App& app, CommandLine& line) {
  auto [command, explain] = add_command<ExplainArguments>(app, line, "explain");
  add(command, "file", explain.file);
  add(command, "--keys", explain.keys)->excludes(add(command, "--results", explain.results));
  add(command, "--grid", explain.picture);
}

}  // namespace launchsafe::app
