// launchsafe study: many cases, kept as they end, then tables and an answer; with --dry-run what these would
// cost.
#include "commands.hpp"
#include "explain.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/run/model_version.hpp"
#include "output_folder.hpp"
#include "study_session.hpp"

namespace launchsafe::app {
namespace {

study::StudyOptions options_of(const StudyArguments& arguments, int jobs, store::CaseStore* store) {
  study::StudyOptions options;
  options.jobs = jobs;
  options.memory_limit = arguments.memory.value_or(options.memory_limit);
  options.time_limit = arguments.time_limit.value_or(options.time_limit);
  options.longest_run = arguments.longest_run.value_or(options.longest_run);
  options.shard = arguments.shard;
  options.stop = &stop_requested();
  options.store = store;
  return options;
}

/// Where not one case may run, unless an earlier study left results here.
std::optional<scene::InputError> refusal_of(const study::StudyFile& file, const StudyArguments& arguments,
                                            const study::StudyOptions& options) {
  if (holds_store(arguments.output)) return std::nullopt;
  run::Reach reach{.longest_run = options.longest_run};
  if (!arguments.memory) reach.memory = study::available_memory();
  return study::all_out_of_reach(file, reach);
}

/// Whether runs of the past tell how fast this machine is.
bool knows_rate(const store::CaseStore* store) {
  if (store == nullptr) return false;
  const std::vector<store::RunRecord> entries = store->records();
  return std::ranges::any_of(entries, [](const store::RunRecord& entry) {
    return entry.state == store::CaseState::done && entry.wall_time > 0 && entry.predicted_updates > 0;
  });
}

/// The store in the study's folder, only to be looked at, or nullptr where there is none.
store::Result<std::unique_ptr<store::CaseStore>> store_for(const StudyArguments& arguments) {
  if (arguments.output.empty() || !holds_store(arguments.output)) return std::unique_ptr<store::CaseStore>{};
  return store::CaseStore::open_to_read(arguments.output, run::model_version);
}

/// Says so where the study itself would refuse the folder.
void remark_obstacle(const study::StudyFile& file, const StudyArguments& arguments, const Console& console) {
  if (arguments.output.empty()) return;
  if (const auto obstacle = obstacle_in_folder(arguments.output, kinds::kind_of(file.study),
                                               study_manifest(file, 1), arguments.update))
    console.remark(*obstacle);
}

/// What the study would run, and at what cost; nothing is written.
ExitCode dry_run(const study::StudyFile& file, const StudyArguments& arguments, Console& console) {
  remark_obstacle(file, arguments, console);
  const auto store = store_for(arguments);
  if (!store) return console.end_with(store.error());
  const std::optional<double> update_rate =
      knows_rate(store->get()) ? 0.0 : measured_update_rate(file.cases.front().scene.scene, console);
  if (!update_rate) return ExitCode::interrupted;
  const study::Forecast forecast =
      study::forecast_study(file, options_of(arguments, arguments.jobs, store->get()), *update_rate);
  if (*store) {
    for (const std::string& remark : (*store)->remarks()) console.remark(remark);
  }
  console.print_text(forecast_text(file, forecast, arguments.output, std::time(nullptr)));
  console.print_json(forecast_json(file, forecast));
  return ExitCode::done;
}

}  // namespace

ExitCode perform(const StudyArguments& arguments, Console& console) {
  const auto file = kinds::read_study(arguments.study, {arguments.tolerance});
  if (!file) return console.refuse(file.error());
  if (arguments.output.empty() && !arguments.dry_run)
    return console.refuse(
        "study: --output is required unless with --dry-run (launchsafe study --help shows the usage)");
  for (const std::string& note : file->scene.notes) console.remark(note);
  if (!file->chosen_setting.empty()) console.remark("setting: " + file->chosen_setting);
  if (arguments.dry_run) return dry_run(*file, arguments, console);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  study::StudyOptions options = options_of(arguments, jobs, nullptr);
  if (const auto error = refusal_of(*file, arguments, options)) return console.refuse(*error);
  StudySession session(
      {arguments.study, arguments.output, kinds::kind_of(file->study), arguments.update,
       arguments.shard.part(), arguments.command, study_manifest(*file, options.jobs), arguments.until},
      console);
  if (const ExitCode code = session.open(); code != ExitCode::done) return code;
  return session.conclude(session.run(*file, options), options.shard);
}

}  // namespace launchsafe::app
