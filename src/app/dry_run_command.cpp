// launchsafe study --dry-run: what a study would run, and at what cost.
#include "commands.hpp"
#include "forecast_text.hpp"
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/study/forecast.hpp"
#include "signals.hpp"
#include "study_folder.hpp"
#include "study_manifest.hpp"
#include "update_rate.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace launchsafe::app {
namespace {

/// Whether runs of the past tell how fast this machine is.
bool knows_rate(const store::CaseStore* store) {
  if (store == nullptr) return false;
  const std::vector<store::JournalEntry> entries = store->entries();
  return std::any_of(entries.begin(), entries.end(), [](const store::JournalEntry& entry) {
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
  if (const auto obstacle =
          obstacle_in_folder(arguments.output, file.study.kind, study_manifest(file, 1), arguments.update))
    console.remark(*obstacle);
}

study::StudyOptions dry_run_options(const StudyArguments& arguments, store::CaseStore* store) {
  study::StudyOptions options;
  options.jobs = arguments.jobs;
  options.time_limit = arguments.time_limit.value_or(options.time_limit);
  options.memory_limit = arguments.memory.value_or(options.memory_limit);
  options.longest_run = arguments.longest_run.value_or(options.longest_run);
  options.shard = arguments.shard;
  options.store = store;
  return options;
}

}  // namespace

ExitCode dry_run_command(const StudyArguments& arguments, Console& console) {
  const auto file = study::read_study(arguments.study, {arguments.tolerance});
  if (!file) {
    console.error(file.error());
    return ExitCode::bad_input;
  }
  if (!file->chosen_setting.empty()) console.remark("setting: " + file->chosen_setting);
  remark_obstacle(*file, arguments, console);
  const auto store = store_for(arguments);
  if (!store) {
    console.error(store.error().message);
    return ExitCode::failed;
  }
  const double update_rate =
      knows_rate(store->get()) ? 0.0 : measured_update_rate(file->cases.front().scene.scene);
  if (stop_requested()) {
    console.error("interrupted while measuring the speed of this machine; there is nothing to keep");
    return ExitCode::interrupted;
  }
  const study::Forecast forecast =
      study::forecast_study(*file, dry_run_options(arguments, store->get()), update_rate);
  if (*store) {
    for (const std::string& remark : (*store)->remarks()) console.remark(remark);
  }
  console.print_text(forecast_text(*file, forecast, arguments.output));
  console.print_json(forecast_json(*file, forecast));
  return ExitCode::done;
}

}  // namespace launchsafe::app
