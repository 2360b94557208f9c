// launchsafe study: many cases, kept as they end, then tables and an answer; with --dry-run what these would
// cost.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/report/study_status.hpp"
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

/// What the study would run, and at what cost; nothing is written.
ExitCode dry_run(const study::StudyFile& file, const StudyArguments& arguments, Console& console) {
  const path& folder = arguments.output;
  // Where the study itself would refuse the folder.
  if (!folder.empty())
    if (const auto obstacle =
            obstacle_in_folder(folder, kinds::kind_of(file.study), study_manifest(file, 1), arguments.update))
      console.remark(*obstacle);
  std::unique_ptr<store::CaseStore> store;
  if (!folder.empty() && holds_store(folder)) {
    auto opened = store::CaseStore::open_to_read(folder);
    if (!opened) return console.end_with(opened.error());
    store = std::move(*opened);
  }
  // Runs of the past tell how fast this machine is.
  const auto tells_rate = [](const store::RunRecord& entry) {
    return entry.state == store::CaseState::done && entry.wall_time > 0 && entry.predicted_updates > 0;
  };
  const double update_rate = store && std::ranges::any_of(store->records(), tells_rate)
                                 ? 0.0
                                 : measured_update_rate(file.cases.front().scene.scene, console);
  const study::Forecast forecast =
      study::forecast_study(file, options_of(arguments, arguments.jobs, store.get()), update_rate);
  if (store)
    for (const std::string& remark : store->remarks()) console.remark(remark);
  console.print_text(forecast_text(file, forecast, folder, std::time(nullptr)));
  console.print_json(forecast_json(file, forecast));
  return ExitCode::done;
}

}  // namespace

ExitCode perform(const StudyArguments& arguments, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(arguments.study, {arguments.tolerance}));
  if (arguments.output.empty() && !arguments.dry_run)
    return console.refuse(
        "study: --output is required unless with --dry-run (launchsafe study --help shows the usage)");
  for (const std::string& note : file.scene.notes) console.remark(note);
  if (!file.chosen_setting.empty()) console.remark("setting: " + file.chosen_setting);
  if (arguments.dry_run) return dry_run(file, arguments, console);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  const study::StudyOptions options = options_of(arguments, jobs, nullptr);
  if (const auto error = refusal_of(file, arguments, options)) return console.refuse(*error);
  StudySession session(arguments, file, jobs, console);
  return session.conclude(session.run(options));
}

void add_study(CLI::App& app, CommandLine& line) {
  auto [command, study] = add_command<StudyArguments>(app, line, "study");
  add_required(command, "study", study.study);
  add(command, "-o,--output", study.output);
  add_jobs(command, study.jobs);
  add_amount(command, "--memory", study.memory, parse_size);
  add_amount(command, "--time-limit", study.time_limit, parse_duration);
  add_amount(command, "--longest-run", study.longest_run, parse_duration);
  add_amount(command, "--until", study.until,
             [](const std::string& text) { return report::next_clock_time(text, std::time(nullptr)); });
  add_read(command, "--shard",
           [&shard = study.shard](const std::string& text) { return study::parse_shard(text, shard); });
  add_amount(command, "--tolerance", study.tolerance, parse_temperature_difference);
  add(command, "--dry-run", study.dry_run);
  add(command, "--update", study.update);
}

}  // namespace launchsafe::app
