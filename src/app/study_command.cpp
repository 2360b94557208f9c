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

struct StudyArguments {
  std::filesystem::path study;
  std::filesystem::path output;       ///< folder of cases, tables and report; may be empty for a dry run
  int jobs = 0;                       ///< threads; 0: as many as there are processors for us
  std::optional<double> memory;       ///< bytes of all running cases together
  std::optional<double> time_limit;   ///< s of wall time, of one case
  std::optional<double> longest_run;  ///< s, predicted, of one case; a longer one is refused
  study::Shard shard;                 ///< the part that is ours
  std::optional<double> tolerance;    ///< K, of T max; picks a setting from the study's accuracy record
  std::optional<std::time_t> until;   ///< when it stops, with what it has
  bool dry_run = false;               ///< say what would be run, and run nothing
  bool update = false;                ///< the folder may hold the results of an earlier study
  std::string command;                ///< the whole command, to be repeated in a shell
};

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
  return store::CaseStore::open_to_read(arguments.output);
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
  const double update_rate =
      knows_rate(store->get()) ? 0.0 : measured_update_rate(file.cases.front().scene.scene, console);
  const study::Forecast forecast =
      study::forecast_study(file, options_of(arguments, arguments.jobs, store->get()), update_rate);
  if (*store) {
    for (const std::string& remark : (*store)->remarks()) console.remark(remark);
  }
  console.print_text(forecast_text(file, forecast, arguments.output, std::time(nullptr)));
  console.print_json(forecast_json(file, forecast));
  return ExitCode::done;
}

ExitCode perform(const StudyArguments& arguments, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(arguments.study, {arguments.tolerance}));
  if (arguments.output.empty() && !arguments.dry_run)
    return console.refuse(
        "study: --output is required unless with --dry-run (launchsafe study --help shows the usage)");
  for (const std::string& note : file.scene.notes) console.remark(note);
  if (!file.chosen_setting.empty()) console.remark("setting: " + file.chosen_setting);
  if (arguments.dry_run) return dry_run(file, arguments, console);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  study::StudyOptions options = options_of(arguments, jobs, nullptr);
  if (const auto error = refusal_of(file, arguments, options)) return console.refuse(*error);
  StudySession session(
      {arguments.study, arguments.output, kinds::kind_of(file.study), arguments.update,
       arguments.shard.part(), arguments.command, study_manifest(file, options.jobs), arguments.until},
      console);
  session.open();
  return session.conclude(session.run(file, options), options.shard);
}

}  // namespace

void add_study(CLI::App& app, CommandLine& line) {
  auto [command, study] =
      add_command<StudyArguments>(app, line, "study", "Run a study: many cases, a verdict for every gap");
  study.command = line.text;
  add_required(command, "study", study.study, "STUDY.toml", "Study file");
  add_folder(command, study.output,
             "Folder for cases, tables and report; what is stored there is used again");
  add_jobs(command, study.jobs, "Cases at a time; as many as there are processors unless given");
  add_limits(command, study.memory, study.time_limit);
  add_longest_run(command, study.longest_run);
  const auto read_time = [](const std::string& text) {
    return report::next_clock_time(text, std::time(nullptr));
  };
  add_amount(command, "--until", study.until, read_time, "a time of the day such as 06:00, of the next 24 h",
             "HH:MM",
             "Stop at this local time, as on Ctrl-C: what was run is kept, the same command goes on");
  const auto read_shard = [&shard = study.shard](const std::string& text) {
    return study::parse_shard(text, shard);
  };
  add_read(command, "--shard", read_shard, "i/N such as 2/4", "i/N",
           "Run only part i of N of the mechanical runs; see launchsafe merge");
  add_tolerance(command, study.tolerance);
  command.add_flag("--dry-run", study.dry_run,
                   "Say which mechanical runs it needs and why, and at what cost; write nothing");
  add_update(command, study.update);
}

}  // namespace launchsafe::app
