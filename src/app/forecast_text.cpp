#include "explain.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_status.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/mesh.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::app {
namespace {

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

/// Few of them: those of a large study fill no terminal.
std::string run_list(const Forecast& forecast) {
  constexpr std::size_t most = 20;
  const std::size_t shown = std::min(most, forecast.runs.size());
  const auto first = forecast.runs.begin();
  std::string text =
      report::to_text(run_table({first, first + static_cast<std::ptrdiff_t>(shown)}), width_of_output());
  if (shown < forecast.run_count)
    text += fmt::format("and {} more; --json lists {}\n", forecast.run_count - shown, forecast.runs.size());
  return text;
}

std::string forecast_line(std::string_view label, const std::string& value) {
  return fmt::format("  {:<21} {}\n", label, value);
}

/// What the runs of a forecast add up to.
struct Totals {
  std::size_t stored = 0, refused = 0, to_run = 0;
  double updates = 0;  ///< of particles, in the runs that are left
};

Totals totals_of(const Forecast& forecast) {
  Totals totals;
  for (const ForecastRun& run : forecast.runs) {
    ++(run.refused ? totals.refused : run.stored || run.given_up ? totals.stored : totals.to_run);
    if (!run.stored && !run.given_up)
      totals.updates += static_cast<double>(run.particles) * static_cast<double>(run.steps);
  }
  for (std::size_t* count : {&totals.stored, &totals.refused, &totals.to_run})
    *count = forecast.of_all(*count);
  if (!forecast.runs.empty())
    totals.updates *= static_cast<double>(forecast.run_count) / static_cast<double>(forecast.runs.size());
  return totals;
}

std::string runs_text(const Forecast& forecast) {
  const Totals totals = totals_of(forecast);
  std::string text = fmt::format("{} for {}", forecast.run_count,
                                 report::counted(static_cast<std::int64_t>(forecast.cases), "case"));
  if (forecast.runs.size() < forecast.run_count)
    text += fmt::format("; what follows is estimated from {} of them", forecast.runs.size());
  if (totals.refused > 0) text += fmt::format("; {} refused", totals.refused);
  if (totals.stored > 0 || totals.refused > 0)
    text += fmt::format("; {} stored, {} to run", totals.stored, totals.to_run);
  return text;
}

/// How those runs go, and how much of the time is theirs.
std::string confirmation_text(const scene::Scene& scene, const Forecast& forecast) {
  std::string text;
  if (scene.surface.air_model == scene::AirModel::reservoir &&
      scene.surface.model == scene::GapModel::reservoir)
    text += fmt::format(": from checkpoints of the launch and, after ignition, {} through combustion",
                        scene::time_text(scene.combustion.duration));
  if (forecast.confirmation_time > 0.0)
    text += fmt::format("; about {} of the time", report::duration(forecast.confirmation_time));
  return text;
}

std::string time_text(const Forecast& forecast, const std::filesystem::path& folder) {
  const Totals totals = totals_of(forecast);
  if (totals.refused > 0 && totals.to_run == 0) return "none: nothing is left that may run";
  if (totals.stored == forecast.run_count) return "next to none: every mechanical run is stored";
  const std::string origin =
      forecast.learned_from == 0
          ? "measured now"
          : fmt::format("learned from {} in {}", report::counted(forecast.learned_from, "run"),
                        folder.string());
  return fmt::format("about {} at {:.3g} particle updates per second on a core, {}",
                     report::duration(forecast.time), forecast.update_rate, origin);
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

}  // namespace

std::string forecast_text(const study::StudyFile& file, const Forecast& forecast,
                          const std::filesystem::path& folder, std::optional<std::time_t> begin) {
  std::string text = file.study.title.empty() ? std::string{} : file.study.title + "\n\n";
  text += "Study\n";
  text += forecast_line("kind", file.study.kind.name);
  text += forecast_line("scene", file.study.scene);
  for (const auto& [key, value] : file.overrides) text += forecast_line("  " + key, value);
  text += forecast_line("mechanical runs", runs_text(forecast));
  const bool closes = file.scene.scene.surface.model == scene::GapModel::closing;
  if (forecast.confirmations > 0)
    text += forecast_line("coupled runs", fmt::format("at most {} more, {}{}", forecast.confirmations,
                                                      closes ? "a launch for every gap that closes"
                                                             : "to confirm the critical gap",
                                                      confirmation_text(file.scene.scene, forecast)));
  if (file.study.kind.judges_gaps)
    text += forecast_line(
        "gaps", fmt::format("{} on the trace of each run, then a bisection", file.study.gaps.size()));
  text += forecast_line("at a time", fmt::format("{}", forecast.jobs));
  text += forecast_line("memory", fmt::format("about {:.3g} MB", forecast.memory / 1e6));
  if (forecast.disk > 0)
    text += forecast_line("disk", fmt::format("about {:.3g} MB of cases, rather less as they are compressed",
                                              forecast.disk / 1e6));
  text += forecast_line("time", time_text(forecast, folder));
  if (begin && forecast.time > 0)
    text += forecast_line(
        "end", fmt::format("about {} if it began now, an estimate",
                           report::clock_time(*begin + static_cast<std::time_t>(forecast.time), *begin)));
  return text + "\n" + run_list(forecast);
}

Json forecast_json(const study::StudyFile& file, const Forecast& forecast) {
  const Totals totals = totals_of(forecast);
  return {{"title", file.study.title},
          {"kind", file.study.kind.name},
          {"cases", forecast.cases},
          {"mechanical_runs", forecast.run_count},
          {"estimated_from_runs", forecast.runs.size()},
          {"stored", totals.stored},
          {"to_run", totals.to_run},
          {"refused", totals.refused},
          {"coupled_runs_at_most", forecast.confirmations},
          {"gaps", file.study.gaps.size()},
          {"jobs", forecast.jobs},
          {"particle_updates", totals.updates},
          {"updates_per_second", forecast.update_rate},
          {"rate_learned_from_runs", forecast.learned_from},
          {"memory_bytes", forecast.memory},
          {"disk_bytes", forecast.disk},
          {"predicted_time_s", forecast.time},
          {"predicted_time_of_coupled_runs_s", forecast.confirmation_time},
          {"runs", report::json_rows(run_table(forecast.runs))}};
}

using namespace std::chrono_literals;

double measured_update_rate(const scene::Scene& scene, Console& console) {
  std::atomic<bool> enough{false};
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &enough;
  options.progress = [&](double) {
    if (std::chrono::steady_clock::now() - start > 300ms || stop_requested()) enough = true;
  };
  const run::MechanicsResult run = run::run_mechanics(measurable(scene), options);
  // What is predicted is wall time, on a machine as busy as it is.
  const double rate = run.wall_time > 0.0 ? run.particle_updates() / run.wall_time : 0.0;
  if (stop_requested()) {
    console.error("interrupted while measuring the speed of this machine; there is nothing to keep");
    throw Ended{ExitCode::interrupted};
  }
  return rate > 0.0 ? rate : run::cautious_update_rate;  // where the run breaks at its first step
}

}  // namespace launchsafe::app
