// launchsafe study: many cases, kept as they end, then tables and an answer; with --dry-run what these would
// cost. And launchsafe merge: the shards of a study as one.
#include "common_options.hpp"
#include "explain.hpp"
#include "study_watch.hpp"

namespace launchsafe::app {
namespace {

/// What a user asks of a study, or of the merge of its shards.
struct StudyArguments {
  path study;                        ///< file
  path output;                       ///< folder of cases, tables and report; may be empty for a dry run
  int jobs = 0;                      ///< threads; 0: as many as there are processors for us
  std::optional<double> memory;      ///< bytes of all running cases together
  std::optional<double> time_limit;  ///< s of wall time, of one case
  study::Shard shard;                ///< the part that is ours
  std::optional<std::time_t> until;  ///< when it stops, with what it has
  bool dry_run = false;              ///< say what would be run, and run nothing
  bool update = false;               ///< the folder may hold the results of an earlier study
  std::string command;               ///< the whole command, to be repeated in a shell
};

// --- what both share ---

/// Whether the report in the folder says what a new one would.
bool report_stands(const path& folder, const StudyRecord& record, const StudyRecord& anew) {
  const auto is_there = [&](const std::string& name) { return std::filesystem::exists(folder / name); };
  return !record.files.empty() && std::ranges::all_of(record.files, is_there) && record.complete &&
         same_study(record.manifest, anew.manifest) &&
         store::program_of(record.manifest) == store::program_of(anew.manifest) &&
         record.programs == anew.programs;
}

/// The programs that made what a store holds of this model version.
std::vector<std::string> programs_of(const store::CaseStore& store) {
  std::set<std::string> programs;
  for (const store::RunRecord& each : store.records())
    if (each.model_version == run::model_version) programs.insert(each.program);
  return {programs.begin(), programs.end()};
}

/// A study's folder while it is ours, from before the runs to the report.
class StudySession {
 public:
  /// Takes the folder and opens its store, or ends the command; unless the machine failed nothing was written
  /// then.
  StudySession(const StudyArguments& asked, const study::StudyFile& file, int jobs, Console& console)
      : asked_(asked), file_(file), console_(console), record_{.manifest = study_manifest(file, jobs)} {
    // Never an absolute path: it would name this machine.
    record_.study = asked.study.is_absolute() ? asked.study.filename() : asked.study;
    const auto refuse_obstacle = [&] {
      console.refuse_any(obstacle_in_folder(asked.output, record_.manifest, asked.update));
    };
    refuse_obstacle();
    console.refuse_any(prepare_output_folder(asked.output));
    mark_folder();
    const auto stop = [](const store::Error&) { stop_requested() = true; };
    store_ = console.stored(store::CaseStore::open(asked.output, asked.shard.part(), stop));
    print_remarks();
    refuse_obstacle();  // until the store was ours somebody else may have been at work here
    if (asked.shard.whole()) store::remove_leftovers(asked.output);
    take_folder();
  }

  /// Where results are kept.
  store::CaseStore& store() { return *store_; }

  /// Runs the study, and shows how far it is.
  kinds::StudyOutcome run(study::StudyOptions options) {
    watch_.emplace(*store_, asked_.command, console_.quiet(), asked_.until);
    options.store = store_.get();
    options.progress = watch_->callback();
    kinds::StudyOutcome result = kinds::run_study(file_, options);
    watch_->end_line();
    record_.programs = programs_of(*store_);
    if (const std::vector<std::string> others = record_.other_programs(); !others.empty())
      result.report.remarks.push_back(
          fmt::format("These programs made the launches: {}.", fmt::join(others, "; ")));
    return result;
  }

  /// What the store has to say since the last call.
  void print_remarks() {
    const std::vector<std::string> remarks = store_->remarks();
    for (; remarks_printed_ < remarks.size(); ++remarks_printed_) console_.remark(remarks[remarks_printed_]);
  }

  /// Keeps what is to be kept and reports the outcome of the study: what an interruption left, what a shard
  /// did, or report, tables and answer of the whole.
  ExitCode conclude(const kinds::StudyOutcome& result) {
    try {
      keep();
      if (result.interrupted) report_interruption();
      return end(asked_.shard.whole() ? deliver_whole(result) : deliver_shard(result));
    } catch (const Ended& ended) {
      return end(ended.code);
    }
  }

  /// Tells whoever watches how a study ended that was run.
  ExitCode end(ExitCode code) {
    watch_->tell_end(static_cast<int>(code));
    return code;
  }

 private:
  // These end the command where something fails, or where it was interrupted.
  /// Gives a new folder the manifest by which it is known as ours; another shard may be as far.
  void mark_folder() {
    const auto error = store::write_study_record(asked_.output, record_, false);
    if (error && error->kind != store::Error::Kind::conflict) console_.end_with(*error);
  }

  /// Makes the folder that of the study, once its store is ours alone: the report of an earlier study moves
  /// to `earlier-N`.
  void take_folder() {
    const StudyRecord record = console_.stored(store::record_of_folder(asked_.output));
    if (same_study(record.manifest, record_.manifest)) return;
    if (!record.files.empty()) {
      const path moved = console_.stored(store::set_aside(asked_.output, record));
      console_.remark(fmt::format("the earlier report moved to {}", moved.string()));
    }
    if (const auto error = store::write_study_record(asked_.output, record_, true)) console_.end_with(*error);
  }

  /// Sees to it that all that was to be kept is on disk.
  void keep() {
    const auto error = store_->flush();
    print_remarks();
    if (error)
      console_.fail(fmt::format(
          "{}; the study ended, what was stored before is kept; once there is room, go on with: {}",
          error->message, asked_.command));
  }

  void report_interruption() {
    const auto stored =
        std::ranges::count(store_->records(), store::CaseState::done, &store::RunRecord::state);
    const bool was_planned = asked_.until && std::time(nullptr) >= *asked_.until;
    console_.fail(fmt::format("{}; {} kept in {}; to go on: {}",
                              was_planned ? "stopped at the time that --until says" : "interrupted",
                              stored == 1 ? "1 run is" : fmt::format("{} runs are", stored),
                              asked_.output.string(), asked_.command),
                  ExitCode::interrupted);
  }

  ExitCode deliver_shard(const kinds::StudyOutcome& result) {
    const study::Shard& shard = asked_.shard;
    const std::vector<kinds::Failure>& failures = result.failures;
    console_.print_json({{"shard", shard.index},
                         {"shards", shard.count},
                         {"mechanical_runs", result.timing.runs},
                         {"reused", result.timing.reused},
                         {"wall_time_s", result.timing.wall_time},
                         {"failed", failures.size()}});
    console_.failures(failures);
    console_.remark(report::timing_text(result.timing));
    console_.remark(fmt::format(
        "shard {}/{} is done{}; once all are: {} (then the folders of shards that have one of their own)",
        shard.index, shard.count, failures.empty() ? "" : fmt::format(", {} failed", failures.size()),
        shell_command({"launchsafe", "merge", asked_.study.string(), "-o", asked_.output.string()})));
    return failures.empty() ? ExitCode::done : ExitCode::cases_failed;
  }

  ExitCode deliver_whole(const kinds::StudyOutcome& result) {
    console_.print_text(report::to_text(result.report, asked_.output, width_of_output()));
    if (console_.json()) console_.print_json(Json::parse(result.report.json));
    console_.failures(result.failures);
    console_.remark(report::timing_text(result.timing));
    write_files(result);
    return result.failures.empty() ? ExitCode::done : ExitCode::cases_failed;
  }

  void write_files(const kinds::StudyOutcome& result) {
    StudyRecord written = record_;
    const auto present = store::read_study_record(asked_.output);
    if (result.timing.runs == 0 && result.failures.empty() && present &&
        report_stands(asked_.output, *present, written))
      return console_.remark(fmt::format("the report in {} stands as it is", asked_.output.string()));
    store_->replace_tables(report::plain_tables(result.report));
    keep();
    const report::RenderedReport rendered = report::render_report(result.report, {.stop = &stop_requested()});
    console_.remarks(rendered.remarks);
    written.manifest.wall_time = result.timing.wall_time;
    // A report that lacks a picture is no finished one: the next time it is written again.
    written.complete = rendered.pictures_missing == 0 && result.failures.empty();
    if (const auto error = store::write_report_files(asked_.output, written, rendered.files))
      console_.end_with(*error);
    console_.remark(fmt::format("wrote {} files to {}", rendered.files.size() + 1, asked_.output.string()));
    if (rendered.pictures_missing != 0 && stop_requested())
      console_.fail(
          fmt::format("interrupted while a picture was drawn; all results are kept; for the picture: {}",
                      asked_.command),
          ExitCode::interrupted);
  }

  const StudyArguments& asked_;
  const study::StudyFile& file_;
  Console& console_;
  StudyRecord record_;  ///< what manifest.json is to say before there is a report
  std::unique_ptr<store::CaseStore> store_;
  std::optional<StudyWatch> watch_;  ///< once it runs
  std::size_t remarks_printed_ = 0;
};

// --- study ---

study::StudyOptions options_of(const StudyArguments& arguments, int jobs, store::CaseStore* store) {
  study::StudyOptions options;
  options.jobs = jobs;
  options.memory_limit = arguments.memory.value_or(options.memory_limit);
  options.time_limit = arguments.time_limit.value_or(options.time_limit);
  options.shard = arguments.shard;
  options.stop = &stop_requested();
  options.store = store;
  return options;
}

/// What the study would run, and at what cost; nothing is written.
ExitCode dry_run(const study::StudyFile& file, const StudyArguments& arguments, Console& console) {
  const path& folder = arguments.output;
  std::unique_ptr<store::CaseStore> store;
  if (!folder.empty()) {
    // Where the study itself would refuse the folder.
    if (const auto obstacle = obstacle_in_folder(folder, study_manifest(file, 1), arguments.update))
      console.remark(*obstacle);
    if (holds_store(folder)) store = console.stored(store::CaseStore::open_to_read(folder));
  }
  const Json facts = estimate_json(file, options_of(arguments, arguments.jobs, store.get()), console);
  if (store) console.remarks(store->remarks());
  return console.done(estimate_text(file, facts), facts);
}

ExitCode perform(const StudyArguments& arguments, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(arguments.study));
  if (arguments.output.empty() && !arguments.dry_run)
    console.refuse("--output is required unless with --dry-run" + usage_hint("study "));
  if (arguments.dry_run) return dry_run(file, arguments, console);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  const study::StudyOptions options = options_of(arguments, jobs, nullptr);
  StudySession session(arguments, file, jobs, console);
  return session.conclude(session.run(options));
}

// --- merge ---

struct MergeArguments : StudyArguments {
  std::vector<path> folders;  ///< of shards, to be copied from
};

void import_folders(const std::vector<path>& folders, StudySession& session, Console& console) {
  for (const path& folder : folders) {
    const auto imported = session.store().import_from(folder);
    session.print_remarks();
    if (!imported && imported.error().kind == store::Error::Kind::missing) console.refuse(imported.error());
    if (!imported) console.end_with(imported.error());
    console.remark(fmt::format("{}: copied {} cases, {} were there already", folder.string(), imported->cases,
                               imported->already_there));
  }
}

/// The runs that no shard has stored.
Json missing_runs(const kinds::StudyOutcome& result) {
  Json missing;
  for (const kinds::Failure& failure : result.failures)
    if (failure.outcome == study::RunOutcome::not_stored) missing.push_back({{"run", failure.label}});
  return missing;
}

/// Names what is missing.
ExitCode refuse_without(const Json& missing, Console& console) {
  for (const auto& run : missing) console.print_text("missing: " + run["run"].get<std::string>() + "\n");
  console.print_json({{"missing", missing}});
  console.error(fmt::format("{} results are missing; there is no report", missing.size()));
  return ExitCode::cases_failed;
}

ExitCode perform(const MergeArguments& arguments, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(arguments.study));
  study::StudyOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  options.stop = &stop_requested();
  options.compute = false;
  StudySession session(arguments, file, options.jobs, console);
  import_folders(arguments.folders, session, console);
  options.store = &session.store();
  const kinds::StudyOutcome result = session.run(options);
  if (const auto missing = missing_runs(result); !missing.empty())
    return session.end(refuse_without(missing, console));
  return session.conclude(result);
}

}  // namespace

void add_study(CLI::App& app, CommandLine& line) {
  auto [command, study] = add_command<StudyArguments>(app, line, "study");
  add_required(command, "study", study.study);
  add(command, "-o,--output", study.output);
  add_jobs(command, study.jobs);
  add_amount(command, "--memory", study.memory, parse_positive<Dimension::memory>);
  add_amount(command, "--time-limit", study.time_limit, parse_positive<Dimension::duration>);
  add_amount(command, "--until", study.until,
             [](const std::string& text) { return report::next_clock_time(text, std::time(nullptr)); });
  add_read(command, "--shard",
           [&shard = study.shard](const std::string& text) { return study::parse_shard(text, shard); });
  add(command, "--dry-run", study.dry_run);
  add(command, "--update", study.update);
}

void add_merge(CLI::App& app, CommandLine& line) {
  auto [command, merge] = add_command<MergeArguments>(app, line, "merge");
  add_required(command, "study", merge.study);
  add_required(command, "-o,--output", merge.output);
  add(command, "folder", merge.folders);
  add(command, "--update", merge.update);
  add_jobs(command, merge.jobs);
}

}  // namespace launchsafe::app
