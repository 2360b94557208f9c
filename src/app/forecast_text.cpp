#include "built_in_texts.hpp"
#include "explain.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_status.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/mesh.hpp"

#include <fmt/format.h>

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

std::string forecast_text(const study::StudyFile& file, const Forecast& forecast, const path& folder,
                          std::optional<std::time_t> begin) {
  const scene::Scene& scene = file.scene.scene;
  const bool closes = scene.surface.model == scene::GapModel::closing;
  const bool from_checkpoints = scene.surface.air_model == scene::AirModel::reservoir && !closes;
  const auto megabytes = [](double bytes) { return fmt::format("{:.3g}", bytes / 1e6); };
  // Those of a large study fill no terminal.
  const auto listed = static_cast<std::ptrdiff_t>(std::min<std::size_t>(20, forecast.runs.size()));
  Json facts = forecast_json(file, forecast);
  facts.update({{"scene", file.study.scene},
                {"folder", folder.string()},
                {"judges_gaps", file.study.kind.judges_gaps},
                {"closes", closes},
                {"combustion", from_checkpoints ? scene::time_text(scene.combustion.duration) : ""},
                {"some_left_out", facts["stored"] != 0 || facts["refused"] != 0},
                {"memory_MB", megabytes(forecast.memory)},
                {"disk_MB", forecast.disk > 0 ? megabytes(forecast.disk) : ""},
                {"time", report::duration(forecast.time)},
                {"rate", fmt::format("{:.3g}", forecast.update_rate)},
                {"list", report::to_text(run_table({forecast.runs.begin(), forecast.runs.begin() + listed}),
                                         width_of_output())}});
  if (static_cast<std::size_t>(listed) < forecast.run_count)
    facts["list"].get_ref<std::string&>() +=
        fmt::format("and {} more; --json lists {}\n", forecast.run_count - static_cast<std::size_t>(listed),
                    forecast.runs.size());
  facts[facts["refused"] != 0 && facts["to_run"] == 0 ? "may_not_run"
        : facts["stored"] == forecast.run_count       ? "all_stored"
                                                      : "takes_time"] = true;
  if (forecast.confirmation_time > 0.0)
    facts["confirmation_time"] = report::duration(forecast.confirmation_time);
  if (begin && forecast.time > 0)
    facts["end"] = report::clock_time(*begin + static_cast<std::time_t>(forecast.time), *begin);
  for (const auto& [key, value] : file.overrides)
    facts["overrides"].push_back(fmt::format("{:<19} {}", key, value));
  return told("forecast.txt", facts);
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
