// launchsafe study: many cases, kept as they end, then tables and an answer; with --dry-run the cost of
// these. And launchsafe merge: the shards of a study as one.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/report/study_text.hpp"
#include "study_watch.hpp"

#include <set>
#include <sstream>

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
  std::optional<std::time_t> until;  ///< when it stops, with the cases that it has
  bool dry_run = false;              ///< print the cost, and run nothing
  bool update = false;               ///< the folder may hold the results of an earlier study
  std::string command;               ///< the whole command, to be repeated in a shell
};

/// The manifest of a study: its input is the model version, the study file without remarks and in sorted
/// order, and the scene with what the study sets in it. Every case follows from these.
store::Manifest manifest_of(const study::StudyFile& file) {
  std::ostringstream values;  // of the study file; none if it has gone since it was read
  if (std::filesystem::exists(file.file))
    values << scene::parse_toml(scene::read_text_file(file.file), file.file);
  std::string input = fmt::format("# model version {}\n{}\n\n# scene\n{}", run::model_version, values.str(),
                                  scene::to_toml(file.scene.scene));
  // With another one its report is no longer true.
  if (!file.records.empty())
    input += fmt::format("\n\n# SHA-256 of the files that it rests on\n{}\n", fmt::join(file.records, "\n"));
  if (file.study.kind.own_scenes) {
    std::string scenes;
    for (const study::StudyCase& each : file.cases) scenes += scene::to_toml(each.scene.scene);
    input += "\n\n# SHA-256 of the scenes of all cases\n" + store::sha256(scenes) + "\n";
  }
  return store::make_manifest(input);
}

/// The record of a folder. Throws where the results of a study may not go there: it is not empty and has no
/// manifest of ours, or it holds those of a different study and `update` is not set. Nothing is changed.
store::StudyRecord record_for(const path& folder, const store::Manifest& manifest, bool update) {
  store::StudyRecord record = store::record_of_folder(folder);
  const std::string& present = record.manifest.input_sha256;
  if (!update && !present.empty() && present != manifest.input_sha256)
    throw Ended{
        fmt::format("{} holds the results of a different study or model, and nothing is overwritten; with "
                    "--update stored "
                    "cases are used where they fit, and the report is replaced; or name another folder",
                    folder.string())};
  return record;
}

/// Whether the report in the folder says what a new one would.
bool report_stands(const path& folder, const store::StudyRecord& record, const store::StudyRecord& anew) {
  const auto is_there = [&](const std::string& name) { return std::filesystem::exists(folder / name); };
  return !record.files.empty() && std::ranges::all_of(record.files, is_there) && record.complete &&
         record.manifest.input_sha256 == anew.manifest.input_sha256 &&
         store::program_of(record.manifest) == store::program_of(anew.manifest) &&
         record.programs == anew.programs;
}

/// The programs that made the launches of this model version that a store holds.
std::vector<std::string> programs_of(const store::CaseStore& store) {
  std::set<std::string> programs;
  for (const store::RunRecord& each : store.records())
    if (each.model_version == run::model_version) programs.insert(each.program);
  return {programs.begin(), programs.end()};
}

study::StudyOptions options_of(const StudyArguments& arguments) {
  study::StudyOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  options.memory_limit = arguments.memory.value_or(options.memory_limit);
  options.time_limit = arguments.time_limit.value_or(options.time_limit);
  options.shard = arguments.shard;
  options.stop = &stop_requested;
  return options;
}

/// A study's folder while it is ours, from before the runs to the report.
class StudySession {
 public:
  /// Takes the folder and opens its store.
  StudySession(const StudyArguments& asked, const study::StudyFile& file, Console& console)
      : asked_(asked), file_(file), console_(console), record_{.manifest = manifest_of(file)} {
    // Never an absolute path: it would name this machine.
    record_.study = asked.study.is_absolute() ? asked.study.filename() : asked.study;
    const store::StudyRecord before = record_for(asked.output, record_.manifest, asked.update);
    prepare_output_folder(asked.output);
    if (before.manifest.input_sha256.empty()) store::write_study_record(asked.output, record_);
    store_ = store::CaseStore::open(asked.output, [](const store::Error&) { stop_requested = true; });
    // Until the store was ours somebody else may have been at work here.
    present_ = record_for(asked.output, record_.manifest, asked.update);
    store::remove_leftovers(asked.output);
    const study::Shard& shard = asked.shard;
    watch_.emplace(
        *store_,
        store::StudyStatus{.shard = shard.whole() ? "" : fmt::format("{}/{}", shard.index, shard.count),
                           .command = asked.command},
        console.quiet(), asked.until);
  }

  /// Where results are kept.
  store::CaseStore& store() { return *store_; }

  /// Runs the study and reports its outcome: the cases that an interruption left, or that a shard did, or
  /// report, tables and answer of the whole. How it ended is stored.
  ExitCode run(study::StudyOptions options) {
    ExitCode code = ExitCode::failed;
    try {
      code = run_and_report(std::move(options));
    } catch (const Ended& end) {
      watch_->tell_end(end.code);
      throw;
    }
    watch_->tell_end(code);
    return code;
  }

 private:
  ExitCode run_and_report(study::StudyOptions options) {
    options.store = store_.get();
    options.progress = watch_->callback();
    kinds::StudyOutcome result = kinds::run_study(file_, options);
    watch_->end_line();
    record_.programs = programs_of(*store_);
    if (const std::vector<std::string> others = record_.other_programs(); !others.empty())
      result.report.remarks.push_back(
          fmt::format("These programs made the launches: {}.", fmt::join(others, "; ")));
    console_.remarks(store_->remarks());
    check_written();
    if (result.interrupted) report_interruption();
    if (!options.compute && refuse_what_is_missing(result.failures)) return ExitCode::cases_failed;
    asked_.shard.whole() ? report_whole(result) : report_shard(result);
    console_.failures(result.failures);
    console_.remark(report::timing_text(result.timing));
    if (asked_.shard.whole()) write_files(result);
    return result.failures.empty() ? ExitCode::done : ExitCode::cases_failed;
  }

  /// Throws where something that was to be kept is not on disk.
  void check_written() {
    if (const auto error = store_->flush())
      throw Ended{
          fmt::format("{}; the study ended, earlier results are kept; once there is room, go on with: {}",
                      error->message, asked_.command),
          ExitCode::failed};
  }

  [[noreturn]] void report_interruption() {
    const auto stored =
        std::ranges::count(store_->records(), store::CaseState::done, &store::RunRecord::state);
    throw Ended{fmt::format("interrupted; {} runs are kept in {}; to go on: {}", stored,
                            asked_.output.string(), asked_.command),
                ExitCode::interrupted};
  }

  /// Names the runs that no shard has stored.
  bool refuse_what_is_missing(const std::vector<kinds::Failure>& failures) {
    Json missing = Json::array();
    for (const kinds::Failure& failure : failures) {
      if (failure.outcome != study::RunOutcome::not_stored) continue;
      console_.print_text("missing: " + failure.label + "\n");
      missing.push_back({{"run", failure.label}});
    }
    if (missing.empty()) return false;
    console_.print_json({{"missing", missing}});
    console_.error(fmt::format("{} results are missing; there is no report", missing.size()));
    return true;
  }

  void report_shard(const kinds::StudyOutcome& result) {
    const study::Shard& shard = asked_.shard;
    console_.print_json({{"shard", shard.index},
                         {"shards", shard.count},
                         {"mechanical_runs", result.timing.runs},
                         {"reused", result.timing.reused},
                         {"wall_time_s", result.timing.wall_time},
                         {"failed", result.failures.size()}});
    console_.remark(fmt::format("shard {}/{} is done; once all are: launchsafe merge {} -o DIR SHARD_DIR...",
                                shard.index, shard.count, asked_.study.string()));
  }

  void report_whole(const kinds::StudyOutcome& result) {
    console_.print_text(report::to_text(result.report, width_of_output()));
    if (console_.json()) console_.print_json(Json::parse(result.report.json));
  }

  void write_files(const kinds::StudyOutcome& result) {
    if (result.timing.runs == 0 && result.failures.empty() && report_stands(asked_.output, present_, record_))
      return console_.remark(fmt::format("the report in {} stands as it is", asked_.output.string()));
    store_->replace_tables(report::plain_tables(result.report));
    check_written();
    const report::RenderedReport rendered = report::render_report(result.report, {.stop = &stop_requested});
    console_.remarks(rendered.remarks);
    record_.manifest.wall_time = result.timing.wall_time;
    // A report that lacks a picture is no finished one: the next time it is written again.
    record_.complete = rendered.pictures_missing == 0 && result.failures.empty();
    store::write_report_files(asked_.output, record_, rendered.files);
    console_.remark(fmt::format("wrote {} files to {}", rendered.files.size() + 1, asked_.output.string()));
    if (rendered.pictures_missing != 0 && stop_requested) report_interruption();
  }

  const StudyArguments& asked_;
  const study::StudyFile& file_;
  Console& console_;
  store::StudyRecord record_, present_;  ///< of the study, and what manifest.json had before
  std::unique_ptr<store::CaseStore> store_;
  std::optional<StudyWatch> watch_;
};

/// The launches that the study would run, and their cost; nothing is written.
ExitCode dry_run(const study::StudyFile& file, const StudyArguments& arguments, Console& console) {
  std::unique_ptr<store::CaseStore> store;
  if (!arguments.output.empty()) record_for(arguments.output, manifest_of(file), arguments.update);
  if (!arguments.output.empty() && std::filesystem::exists(store::results_file(arguments.output)))
    store = store::CaseStore::open_to_read(arguments.output);
  study::StudyOptions options = options_of(arguments);
  options.store = store.get();
  const Json facts = estimate_json(file, options);
  return console.done(estimate_text(file, facts), facts);
}

ExitCode perform(const StudyArguments& arguments, Console& console) {
  if (arguments.output.empty() && !arguments.dry_run)
    throw Ended{"--output is required unless with --dry-run (launchsafe study --help shows the usage)"};
  const study::StudyFile file = kinds::read_study(arguments.study).or_throw();
  if (arguments.dry_run) return dry_run(file, arguments, console);
  return StudySession(arguments, file, console).run(options_of(arguments));
}

struct MergeArguments : StudyArguments {
  std::vector<path> folders;  ///< of shards, to be copied from
};

ExitCode perform(const MergeArguments& arguments, Console& console) {
  const study::StudyFile file = kinds::read_study(arguments.study).or_throw();
  StudySession session(arguments, file, console);
  for (const path& folder : arguments.folders)
    console.remark(fmt::format("{}: copied {} cases", folder.string(), session.store().import_from(folder)));
  study::StudyOptions options = options_of(arguments);
  options.compute = false;
  return session.run(options);
}

constexpr const char* update_meaning = "Use the stored cases of another study in DIR; its report is replaced";

}  // namespace

void add_study(CLI::App& app, CommandLine& line) {
  auto [command, study] =
      add_command<StudyArguments>(app, line, "study", "Run a study: many cases, a verdict for every gap");
  add(command, "study", study.study, "STUDY.toml", "Study file")->required();
  add(command, "-o,--output", study.output, "DIR",
      "Folder for cases, tables and report; stored cases there are used again");
  add_jobs(command, study.jobs);
  add_quantity(command, "--memory", study.memory, scene::Dimension::memory,
               "Memory of all running cases together, such as 8GB; most of the free memory unless given",
               "a size such as 500MB, 8GB or 1.5GiB");
  add_quantity(command, "--time-limit", study.time_limit, scene::Dimension::duration,
               "Wall time after which a case is given up", "a duration such as 90s, 10min, 2h or 1d");
  add_read(command, "--until", "HH:MM",
           "Stop at this local time, as on Ctrl-C: finished cases are kept, the same command goes on",
           "a time of the day such as 06:00, of the next 24 h",
           [&until = study.until](const std::string& text) {
             return (until = report::next_clock_time(text, std::time(nullptr))).has_value();
           });
  add_read(command, "--shard", "i/N", "Run only part i of N of the launches; see launchsafe merge",
           "i/N with i from 1 to N, such as 2/4",
           [&shard = study.shard](const std::string& text) { return study::parse_shard(text, shard); });
  command.add_flag("--dry-run", study.dry_run,
                   "Print how many launches it needs, and their cost; write nothing");
  command.add_flag("--update", study.update, update_meaning);
}

void add_merge(CLI::App& app, CommandLine& line) {
  auto [command, merge] = add_command<MergeArguments>(
      app, line, "merge", "Make one report of the shards of a study; runs nothing");
  add(command, "study", merge.study, "STUDY.toml", "Study file")->required();
  add(command, "-o,--output", merge.output, "DIR", "Folder for cases, tables and report")->required();
  add(command, "folder", merge.folders, "SHARD_DIR...", "Folders of the shards");
  command.add_flag("--update", merge.update, update_meaning);
  add_jobs(command, merge.jobs);
}

}  // namespace launchsafe::app
